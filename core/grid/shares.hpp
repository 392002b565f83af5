#pragma once

#include <vector>

namespace tushar::grid {

/// A distribution of patches over ranks: rank r has the patches from `offsets[r]` up to but excluding `offsets[r + 1]`.
using RankOffsets = std::vector<int>;

/// Distributes consecutive patches over `ranks` ranks so that the largest sum of `costs` on any rank is as small as
/// possible. Rank 0 always has a patch.
RankOffsets evenShares(const std::vector<double>& costs, int ranks);

/// The sum of the costs on the busiest rank.
double greatestShare(const std::vector<double>& costs, const RankOffsets& offsets);

}  // namespace tushar::grid
