#include "core/simulation/balance.hpp"

#include <algorithm>
#include <numeric>

namespace tushar::simulation {

std::optional<grid::RankOffsets> Balance::better(const std::vector<double>& costs, const grid::RankOffsets& now,
                                                 int step) {
  constexpr double worthwhile = 0.9;
  next_ = steps_ + std::clamp(steps_, soonest, latest);
  grid::RankOffsets offsets = grid::evenShares(costs, ranks_);
  const double most = grid::greatestShare(costs, now), less = grid::greatestShare(costs, offsets);
  if (less > worthwhile * most || most - less <= change_) return std::nullopt;
  const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / ranks_;
  report_ = {report_.times + 1, step, most / mean, less / mean};
  return offsets;
}

}  // namespace tushar::simulation
