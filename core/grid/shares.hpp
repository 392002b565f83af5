#pragma once

#include <vector>

namespace tushar::grid {

/// Which patches go to which rank: rank r has those from `offsets[r]` to `offsets[r + 1]`.
using RankOffsets = std::vector<int>;

/// Of all ways to give `ranks` ranks consecutive patches, one with the least sum of `costs` on the rank that has most.
/// Rank 0 always has a patch.
RankOffsets evenShares(const std::vector<double>& costs, int ranks);

/// The sum of costs on the rank that has most.
double greatestShare(const std::vector<double>& costs, const RankOffsets& offsets);

}  // namespace tushar::grid
