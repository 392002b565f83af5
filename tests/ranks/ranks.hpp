#pragma once

#include <functional>

#include "core/base/mpi.hpp"
#include "core/core.hpp"
#include "core/grid/partition.hpp"
#include "tests/support/run.hpp"

namespace tushar::test {

/// Returns the communicator of all ranks of the test program.
const mpi::Communicator& allRanks();

/// Runs `test` on the first `count` ranks; the others wait for the next call.
inline void onRanks(int count, const std::function<void(const mpi::Communicator&)>& test) {
  const bool takesPart = allRanks().rank() < count;
  const mpi::Communicator some = allRanks().split(takesPart ? 1 : 0);
  if (takesPart) test(some.size() > 1 ? some : mpi::Communicator::alone());
}

inline grid::Share shareOf(const mpi::Communicator& ranks) { return {ranks.rank(), ranks.size()}; }

/// Returns the number of a cell or node of `plane`, equal for all its periodic images.
inline double numberOf(const Index<2>& at, bool periodic) {
  const auto wrapped = [&](int k, int cells) { return periodic ? (k % cells + cells) % cells : k; };
  return 1 + wrapped(at[0], 12) + 1000 * wrapped(at[1], 10);
}

inline constexpr CellLabel<double> number{"c.number", "1", "number of the cell", Bound::positive};
inline constexpr ReductionLabel<Sum> wrong{"wrong", "1", "values that are not what they should be"};

/// A grid of 12 x 10 cells.
inline grid::Domain plane(const Index3& patches, bool periodic) {
  grid::Domain domain = test::domain({{12, 10, 1}}, patches);
  if (periodic) domain.boundaries = {};
  for (int axis = 0; axis < 2; ++axis) domain.periodic[axis] = periodic ? 1 : 0;
  for (const int side : {0, 1}) domain.boundaries.face(2, side) = {{grid::symmetric, grid::BoundaryKind::symmetry}};
  return domain;
}

}  // namespace tushar::test
