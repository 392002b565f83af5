#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "components/euler/boundary.hpp"
#include "core/core.hpp"

namespace tushar::ice {

/// Number of layers of cells around a patch whose velocities its tracers may need: they move by at most a cell.
inline constexpr int flowReach = 2;

/// The velocity with which tracers move. Between the centres of cells it is interpolated multilinearly. Beyond a side
/// of the grid, cells have the velocities that the gas has there: mirrored at walls and symmetry planes, given at other
/// sides, or else those of the nearest cells. A viscous gas has the velocity of a wall at the wall.
template <int D>
class Flow {
 public:
  /// `velocity` of the cells of a patch, with flowReach layers around it; conditions at sides apply at `time` [s].
  Flow(const Patch& patch, const euler::Gas& gas, double time, CellView<const Vec<D>> velocity)
      : level_(patch.level()), gas_(lawless(gas)), velocity_(velocity), is_near_side_(isNearSide(patch)) {
    if (!is_near_side_) return;
    rules_ = euler::ghostRules<D>(level_, gas_, time, patch.cells().grown(flowReach, D));
    if (gas_.sticks) at_walls_ = euler::diffusionRules<D>(level_, gas_, time);
  }

  /// The velocity of a cell, which may be beyond a side.
  Vec<D> of(Index<D> cell) const {
    if (!is_near_side_) return velocity_[cell];
    std::array<euler::GhostRule<D>, D> applied;
    int count = 0;
    for (int d = 0; d < D; ++d) {
      const int last = level_.cells().upper[d] - 1;
      if (level_.isPeriodic(d) || (cell[d] >= 0 && cell[d] <= last)) continue;
      const int side = cell[d] < 0 ? 0 : 1;
      const euler::GhostRule<D>& rule = applied[count++] = ruleAt(cell, d, side);
      const int mirrored = side == 0 ? -1 - cell[d] : 2 * last + 1 - cell[d];
      cell[d] = std::clamp(rule.mirrored ? mirrored : cell[d], 0, last);
    }
    Vec<D> v = velocity_[cell];
    for (int k = count - 1; k >= 0; --k)
      for (int d = 0; d < D; ++d)
        v[d] = applied[k].factor[euler::kVelocity(d)] * v[d] + applied[k].value[euler::kVelocity(d)];
    return v;
  }

  /// The velocity at a point [m] in the cell `near`, or at most one cell away from it.
  Vec<D> at(const Vec<D>& x, const Index<D>& near) const {
    Index<D> first;
    Vec<D> part;
    for (int d = 0; d < D; ++d) {
      const double along = (x[d] - level_.nodePosition(d, 0)) * level_.inverseSpacing(d) - 0.5;
      const double below = std::clamp(std::floor(along), near[d] - 2.0, near[d] + 1.0);
      first[d] = static_cast<int>(below);
      part[d] = std::clamp(along - below, 0.0, 1.0);
    }
    std::array<Vec<D>, 1 << D> v;
    for (int k = 0; k < (1 << D); ++k) {
      Index<D> cell = first;
      for (int d = 0; d < D; ++d) cell[d] += (k >> d) & 1;
      v[k] = of(cell);
    }
    for (int d = D - 1; d >= 0; --d)
      for (int k = 0; k < (1 << d); ++k) v[k] += part[d] * (v[k + (1 << d)] - v[k]);
    return v[0];
  }

  /// Moves a point beyond a wall or symmetry plane, near which the cell `near` lies, back into the grid as if the plane
  /// reflected it.
  void reflect(Vec<D>& x, const Index<D>& near) const {
    if (!is_near_side_) return;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        const double plane = level_.nodePosition(d, side == 0 ? 0 : level_.cells().upper[d]);
        if (level_.isPeriodic(d) || !(side == 0 ? x[d] < plane : x[d] > plane)) continue;
        Index<D> beyond = near;
        beyond[d] = side == 0 ? -1 : level_.cells().upper[d];
        if (level_.isSymmetry(d, side) || euler::ruleAt<D>(level_, rules_, d, side, beyond).mirrored)
          x[d] = 2 * plane - x[d];
      }
  }

 private:
  euler::GhostRule<D> ruleAt(const Index<D>& cell, int axis, int side) const {
    const euler::GhostRule<D> rule = euler::ruleAt<D>(level_, rules_, axis, side, cell);
    return rule.mirrored && gas_.sticks ? euler::ruleAt<D>(level_, at_walls_, axis, side, cell) : rule;
  }
  /// Only the velocities beyond sides are needed, which do not depend on the law of the gas.
  static euler::Gas lawless(euler::Gas gas) {
    gas.law.reset();
    return gas;
  }
  static bool isNearSide(const Patch& patch) {
    bool isNear = false;
    for (int d = 0; d < D; ++d)
      isNear = isNear ||
               (!patch.level().isPeriodic(d) && (patch.cells().lower[d] < flowReach ||
                                                 patch.cells().upper[d] > patch.level().cells().upper[d] - flowReach));
    return isNear;
  }

  const Level& level_;
  euler::Gas gas_;
  CellView<const Vec<D>> velocity_;
  bool is_near_side_;
  euler::GhostRules<D> rules_, at_walls_;
};

}  // namespace tushar::ice
