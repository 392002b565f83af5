#pragma once

#include <vector>

namespace tushar::grid {

/// A distribution of patches to ranks: rank r has those from `offsets[r]` to `offsets[r + 1]`.
using RankOffsets = std::vector<int>;

/// Distributes consecutive patches to `ranks` ranks so that the largest sum of `costs` on a rank is as small as
/// possible. Rank 0 always has a patch.
RankOffsets evenShares(const std::vector<double>& costs, int ranks);

/// The sum of costs on the busiest rank.
double greatestShare(const std::vector<double>& costs, const RankOffsets& offsets);

}  // namespace tushar::grid
