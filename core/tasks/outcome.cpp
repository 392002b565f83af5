#include "core/tasks/outcome.hpp"

#include <string>
#include <tuple>

namespace tushar::tasks {

void Outcome::merge(const Outcome& other) {
  if (task == other.task && kind == Kind::shortensStep && other.kind == Kind::shortensStep)
    return factor.merge(other.factor);
  const auto order = [](const Outcome& one) {
    return std::tuple(one.task, one.kind == Kind::shortensStep ? 0 : 1, one.material, one.kind, one.place, one.rank);
  };
  if (order(other) < order(*this)) *this = other;
}

NumericalError broadcastError(const mpi::Communicator& ranks, const std::optional<NumericalError>& mine, int from) {
  const bool isMine = ranks.rank() == from;
  const std::string what = ranks.broadcast(isMine ? std::string(mine->what()) : "", from);
  const std::string advice = ranks.broadcast(isMine ? mine->advice() : "", from);
  const std::string value = ranks.broadcast(isMine ? mine->value() : "", from);
  return {what, advice, value, ranks.broadcast(isMine ? mine->cell() : std::uint64_t{0}, from)};
}

}  // namespace tushar::tasks
