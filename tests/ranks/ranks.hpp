#pragma once

#include <functional>

#include "core/base/mpi.hpp"
#include "core/grid/partition.hpp"
#include "tests/support/run.hpp"

namespace tushar::test {

/// All ranks that the tests were started on.
const mpi::Communicator& allRanks();

/// Runs `test` on the first `count` of all ranks; the others wait for the next call.
inline void onRanks(int count, const std::function<void(const mpi::Communicator&)>& test) {
  const bool takesPart = allRanks().rank() < count;
  const mpi::Communicator some = allRanks().split(takesPart ? 1 : 0);
  if (takesPart) test(some.size() > 1 ? some : mpi::Communicator::alone());
}

inline grid::Share shareOf(const mpi::Communicator& ranks) { return {ranks.rank(), ranks.size()}; }

}  // namespace tushar::test
