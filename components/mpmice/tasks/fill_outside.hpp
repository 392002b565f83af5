#pragma once

#include <fmt/format.h>

#include "components/mpmice/free_shares.hpp"
#include "core/base/error.hpp"

namespace tushar::mpmice {

/// Throws NumericalError for a cell beside an inner side of a level of several boxes that bodies do not fill.
template <int D>
[[noreturn]] void refuseGasAtInnerSide(const Level& level, const Index<D>& cell, double free) {
  const Vec3 x = level.expandPoint<D>(level.cellCentre<D>(cell));
  throw NumericalError(
      fmt::format("bodies leave {:.3g} of a cell free that lies at an inner side of the grid, at ({:g}, {:g}, {:g}); "
                  "gas is not available there",
                  free, x[0], x[1], x[2]),
      "a body that fills all cells along the inner sides of the boxes, or a Level of one Box", "c.freeVolume",
      level.cellNumber<D>(cell));
}

/// On a level of several boxes, takes the space outside them, as if a body at rest filled it: its cells are not free,
/// and their faces are covered. `fractions` contain what bodies leave free of the cells of a patch.
///
/// Gas has no condition at inner sides. So bodies must leave less than `most` of the cells along them free; otherwise
/// throws NumericalError.
template <int D>
void fillOutside(const Level& level, const FreeShares<D>& fractions, double most) {
  if (!level.boxes()) return;
  forEach<D>(fractions.volume.box(), [&](const Index<D>& cell) {
    const bool isInside = level.isInside<D>(cell);
    double& free = fractions.volume[cell];
    if (!isInside) free = 0;
    for (int d = 0; d < D; ++d) {
      const Index<D> below = cell - Index<D>::unit(d), above = cell + Index<D>::unit(d);
      const auto isOutside = [&](const Index<D>& at) { return level.cells().contains(at) && !level.isInside<D>(at); };
      if (!isInside || isOutside(below)) fractions.coverage[cell][d] = 1;
      if (isInside && !(free < most) && (isOutside(below) || isOutside(above)))
        refuseGasAtInnerSide<D>(level, cell, free);
    }
  });
}

}  // namespace tushar::mpmice
