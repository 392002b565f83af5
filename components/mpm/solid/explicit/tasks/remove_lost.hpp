#pragma once

#include <limits>

#include "components/mpm/solid/explicit/tasks/stable_time_step.hpp"
#include "components/mpm/solid/explicit/tasks/state_update.hpp"
#include "core/grid/passed_sides.hpp"

namespace tushar::mpm::solid {

/// The space between the symmetry planes at the sides of the grid [m]; infinite along axes without such planes. On a
/// level of several boxes, the symmetry planes at its inner sides bound it, too.
template <int D>
struct BetweenPlanes {
  Vec<D> lower = Vec<D>::Constant(-std::numeric_limits<double>::infinity()), upper = -lower;
  const Level* severalBoxes = nullptr;  ///< the level, if it consists of several boxes
  int material = 0;

  BetweenPlanes(const Level& level, int number) : severalBoxes(level.boxes() ? &level : nullptr), material(number) {
    for (int d = 0; d < D; ++d) {
      if (level.isSymmetry(d, 0, material)) lower[d] = level.nodePosition(d, 0);
      if (level.isSymmetry(d, 1, material)) upper[d] = level.nodePosition(d, level.cells().upper[d]);
    }
  }
  /// Whether a position is inside, of a particle that was in the cell `from`. A position that is not a number counts as
  /// inside: the relocation reports it as a separate error.
  bool contains(const Index<D>& from, const Vec<D>& x) const { return containAll(from, &x, 1); }
  /// Whether all of `count` positions are inside.
  bool containAll(const Index<D>& from, const Vec<D>* x, int count) const {
    bool inside = true;
    for (int k = 0; k < count; ++k)
      for (int d = 0; d < D; ++d) inside &= !(x[k][d] < lower[d]) & !(x[k][d] > upper[d]);
    return inside && (!severalBoxes || areBetweenInnerPlanes(from, x, count));
  }
  /// The symmetry planes at inner sides through which a particle has passed.
  grid::PassedSides innerPlanes(const Index<D>& from, const Vec<D>& x) const;

 private:
  bool areBetweenInnerPlanes(const Index<D>& from, const Vec<D>* x, int count) const;
};

/// Removes the lost particles of a cell in which a wave speed is undefined or a particle is deformed too much or lies
/// behind a symmetry plane: those that the step turns inside out (det F <= 0), as explicit finite-element codes delete
/// elements with a negative Jacobian, those that it deforms by more than `mostDeformation`, whose F is -I, and those
/// that it throws through a symmetry plane. Returns the crossing rate of the waves of all other particles; `none` is
/// the rate without waves. Throws NumericalError if particles cannot be removed, or if another particle's wave speed is
/// undefined.
template <int D>
CrossingRate<D> withoutLost(const Level& level, const StateUpdate<D>& u, const Index<D>& cell,
                            const data::ParticleRange& range, const CrossingRate<D>& none,
                            const BetweenPlanes<D>& space, const double* waveSpeed);

}  // namespace tushar::mpm::solid
