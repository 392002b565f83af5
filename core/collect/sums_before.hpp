#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::collect {

/// For each of this rank's keys, the sum of the weights of all smaller keys of all ranks. Weights that are left out are
/// 1: then it is the place of the key among all. Keys are ascending, and no key occurs twice on any ranks. A rank needs
/// memory for its own keys and for about as many of the others. Collective.
///
/// Sorts by samples: the keys are cut into as many sections as there are ranks, of about equal length; a rank merges
/// what all have of its section. Source: J. S. Huang and Y. C. Chow, Proc. COMPSAC 1983, 627 (sample sort).
std::vector<std::uint64_t> sumsBefore(const mpi::Communicator& ranks, std::span<const std::uint64_t> keys,
                                      std::span<const std::uint64_t> weights = {});

}  // namespace tushar::collect
