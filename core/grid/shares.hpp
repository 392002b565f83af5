#pragma once

#include <vector>

namespace tushar::grid {

/// Which patches go to which rank: rank r has those from `firsts[r]` to `firsts[r + 1]`.
using Firsts = std::vector<int>;

/// Of all ways to give `ranks` ranks consecutive patches, one with the least sum of `costs` on the rank that has most.
/// The first rank has a patch always.
Firsts evenShares(const std::vector<double>& costs, int ranks);

/// The sum of costs on the rank that has most.
double greatestShare(const std::vector<double>& costs, const Firsts& firsts);

}  // namespace tushar::grid
