#pragma once

#include "components/euler/tasks/mend_new_cells.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// Distance from bodies, in cells, within which all cells are on the finest level, so that no coarser cell has a wall.
/// A step depends on bodies two cells away, and on faces one cell farther.
inline constexpr int markedLayers = 3;

/// Marks cells near bodies for refinement.
template <int D>
void markBodies(const Patch& patch, CellView<const double> free, Marks marks) {
  forEach<D>(free.box(), [&](const Index<D>& cell) {
    if (!(free[cell] < 1)) return;
    forEach<D>(cellsAround<D>(cell, markedLayers).intersect(patch.cells()),
               [&](const Index<D>& at) { marks.refine(at); });
  });
}

/// Views of the variables of several gases that regridding changes.
struct ChangedGases {
  std::vector<euler::ChangedGas> of;

  static ChangedGases from(auto& take, std::size_t gases) {
    ChangedGases all;
    for (std::size_t k = 0; k < gases; ++k)
      all.of.push_back({take(modifies(c::massOfGas[k])), take(modifies(c::shareOfGas[k]))});
    return all;
  }
};

/// Replaces impossible values of several gases that were interpolated in new cells.
template <int D>
void mendNewGases(const Patch& patch, const std::vector<euler::Settings>& gases, const std::vector<Box>& newCells,
                  const euler::ChangedState<D>& state, const ChangedGases& held) {
  euler::mendNewMixture<D>(patch, gases, newCells, state, held.of);
}

}  // namespace tushar::mpmice
