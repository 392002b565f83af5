#include "core/report/time_use.hpp"

#include <algorithm>

namespace tushar::report {

TimeUse::TimeUse(const Threads::Use& before, const Threads& threads, double wall, double outputSeconds,
                 const mpi::Communicator& ranks) {
  constexpr double nano = 1e-9;
  const auto ofAll = [&](double seconds) {
    return nano * static_cast<double>(ranks.sum(static_cast<long>(seconds / nano)));
  };
  task = ofAll(threads.use().task - before.task);
  message = ofAll(threads.use().message - before.message);
  output = ofAll(outputSeconds);
  const double count = static_cast<double>(ranks.sum(threads.count()));
  wait = std::max(0.0, ofAll(threads.count() * wall) - task - message - output);
  const double longest = ranks.max(threads.use().loops - before.loops);
  if (task + message > 0) imbalance = count * longest / (task + message);
}

}  // namespace tushar::report
