#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::collect {

/// What is wrong if ids repeat.
inline constexpr const char* repeatedIds =
    "several particles of a material have the same id; ParticleMaker::add needs one that no other particle of the "
    "material has, on any patch";

/// For each of this rank's keys, returns the sum of the weights of all smaller keys on all ranks. Without weights, each
/// key counts as 1, so the sum is the key's position in the global order. Keys must be ascending and unique on each
/// rank; if several ranks have the same key, all ranks throw TaskError. A rank needs memory for its own keys and for
/// about as many of other ranks. Collective.
///
/// Uses sample sort: the range of keys is cut into as many sections of about equal length as there are ranks, and each
/// rank merges all keys of one section. Source: J. S. Huang and Y. C. Chow, Proc. COMPSAC 1983, 627.
std::vector<std::uint64_t> sumsBefore(const mpi::Communicator& ranks, std::span<const std::uint64_t> keys,
                                      std::span<const std::uint64_t> weights = {});

}  // namespace tushar::collect
