#include "core/output/writers.hpp"

#include <algorithm>

#include "core/base/mpi_together.hpp"

namespace tushar::output {

Writers::Writers(const mpi::Communicator& ranks, std::vector<int> writers)
    : ranks_(&ranks), writers_(std::move(writers)) {
  const auto found = std::find(writers_.begin(), writers_.end(), ranks.rank());
  mine_ = found == writers_.end() ? -1 : static_cast<int>(found - writers_.begin());
}

Writers Writers::spread(const mpi::Communicator& ranks, int count) {
  count = ranks.broadcast(count);
  if (count == 0) return {ranks, mpi::firstOfNodes(ranks)};
  const long most = std::min(count, ranks.size());
  std::vector<int> writers;
  for (long k = 0; k < most; ++k) writers.push_back(static_cast<int>(k * ranks.size() / most));
  return {ranks, std::move(writers)};
}

Writers Writers::only(bool mine) const {
  const auto rank = static_cast<std::uint64_t>(ranks_->rank());
  const bool stays = mine_ == 0 || (mine_ > 0 && mine);
  const std::vector<std::uint64_t> stay = mpi::allOf(*ranks_, {&rank, stays ? 1u : 0u});
  return {*ranks_, {stay.begin(), stay.end()}};
}

}  // namespace tushar::output
