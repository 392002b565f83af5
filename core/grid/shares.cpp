#include "core/grid/shares.hpp"

#include <algorithm>
#include <numeric>

namespace tushar::grid {

namespace {

/// Assigns consecutive patches to each rank as long as their cost is at most `most`; the last rank gets the rest.
RankOffsets filledUpTo(double most, const std::vector<double>& costs, int ranks) {
  RankOffsets offsets{0};
  double share = 0;
  for (std::size_t patch = 0; patch < costs.size(); ++patch) {
    if (patch > 0 && share + costs[patch] > most && static_cast<int>(offsets.size()) < ranks) {
      offsets.push_back(static_cast<int>(patch));
      share = 0;
    }
    share += costs[patch];
  }
  offsets.resize(static_cast<std::size_t>(ranks) + 1, static_cast<int>(costs.size()));
  return offsets;
}

}  // namespace

double greatestShare(const std::vector<double>& costs, const RankOffsets& offsets) {
  double greatest = 0;
  for (std::size_t rank = 0; rank + 1 < offsets.size(); ++rank)
    greatest =
        std::max(greatest, std::accumulate(costs.begin() + offsets[rank], costs.begin() + offsets[rank + 1], 0.0));
  return greatest;
}

RankOffsets evenShares(const std::vector<double>& costs, int ranks) {
  constexpr int halvings = 40;
  double most = std::accumulate(costs.begin(), costs.end(), 0.0), least = most / ranks;
  RankOffsets best = filledUpTo(most, costs, ranks);
  for (int k = 0; k < halvings && least < most; ++k) {
    const double middle = 0.5 * (least + most);
    RankOffsets tried = filledUpTo(middle, costs, ranks);
    if (greatestShare(costs, tried) > middle) {
      least = middle;
      continue;
    }
    most = middle;
    best = std::move(tried);
  }
  return best;
}

}  // namespace tushar::grid
