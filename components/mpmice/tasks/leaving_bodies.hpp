#pragma once

#include "components/mpmice/open_sides.hpp"
#include "components/mpmice/tasks/measure_bodies.hpp"

namespace tushar::mpmice {

/// The open side through which a particle that started the step in a cell leaves the grid, given its new position.
template <int D>
WayOut wayOut(const Level& level, const euler::Gas& gas, const Index<D>& cell, const Vec<D>& x) {
  for (int d = 0; d < D; ++d) {
    if (level.isPeriodic(d) || level.cells().extent(d) < 2) continue;
    const int at = level.cellAlong(d, x[d]);
    if (at >= level.cells().lower[d] && at < level.cells().upper[d]) continue;
    const int side = at < level.cells().lower[d] ? 0 : 1;
    if (isOpenSide<D>(level, gas, nearestOnGrid<D>(level, cell), d, side)) return {d, side == 0 ? -1 : 1};
  }
  return {};
}

/// Sets p.ahead at the start: all particles are in the grid.
template <int D>
void startAhead(const Patch&, const mpm::solid::Material&, ParticleView<const double>, ParticleView<Vec<D>> ahead) {
  for (int p = 0; p < ahead.owned(); ++p) ahead[p] = Vec<D>::Zero();
}

/// Finds the particles that follow others out of the grid. A particle is removed when its centre leaves; then the one
/// behind it, in the direction out of the grid, is at most one and a half edges of its box away, and at most half an
/// edge beside it. It remains a follower as long as it is within one edge of the side.
template <int D>
class Followers {
 public:
  Followers(const Level& level, const euler::Gas& gas, const Boxes<D>& boxes)
      : level_(level), gas_(gas), boxes_(boxes) {}

  /// Whether particles that started the step in a cell may follow others.
  bool areNear(const Index<D>& cell) const {
    constexpr int far = 2 * boxReach + 1;  // one and a half edges and a step
    bool near = false;
    for (int d = 0; d < D; ++d)
      near |= !level_.isPeriodic(d) &&
              (cell[d] < level_.cells().lower[d] + far || cell[d] >= level_.cells().upper[d] - far);
    return near;
  }
  /// The new value of p.ahead of a particle that started the step in a cell, given the value before.
  Vec<D> aheadOf(const Index<D>& cell, int p, const Vec<D>& before) const {
    Vec<D> ahead = Vec<D>::Zero();
    if (boxes_.x[p][0] == data::removed) return ahead;
    for (int d = 0; d < D; ++d) {
      if (level_.isPeriodic(d) || level_.cells().extent(d) < 2) continue;
      for (const int direction : {-1, 1}) {
        const double edges = edgesTo(p, d, direction);
        const bool stays = before[d] == direction && edges <= 1 + offRoundShares;
        if (stays || (edges < 1.5 && follows(cell, p, d, direction))) ahead[d] = direction;
      }
    }
    return ahead;
  }

 private:
  /// The distance of the centre of a particle from a side, in edges of its box.
  double edgesTo(int p, int axis, int direction) const {
    const int end = direction < 0 ? level_.cells().lower[axis] : level_.cells().upper[axis];
    const double out = direction * (level_.nodePosition(axis, end) - boxes_.x[p][axis]);
    return out * level_.inverseSpacing(axis) / boxes_.edges[p][axis];
  }
  /// Whether a particle beside a particle, or in front of it, leaves the grid through a side.
  bool follows(const Index<D>& cell, int p, int axis, int direction) const {
    bool any = false;
    forEach<D>(cellsAround<D>(cell, boxReach).intersect(boxes_.x.cells()), [&](const Index<D>& at) {
      for (const int q : boxes_.x.template in<D>(at)) any = any || (q != p && isBehind(p, at, q, axis, direction));
    });
    return any;
  }
  bool isBehind(int p, const Index<D>& at, int q, int axis, int direction) const {
    if (boxes_.x[q][0] == data::removed) return false;
    for (int d = 0; d < D; ++d) {
      const double apart = (boxes_.x[q][d] - boxes_.x[p][d]) * level_.inverseSpacing(d) / boxes_.edges[p][d];
      if (d == axis ? !(direction * apart > 0 && direction * apart < 1.5) : !(std::abs(apart) < 0.5)) return false;
    }
    const WayOut way = wayOut<D>(level_, gas_, at, boxes_.x[q]);
    return way.axis == axis && way.direction == direction;
  }

  const Level& level_;
  const euler::Gas& gas_;
  const Boxes<D>& boxes_;
};

template <int D>
void findFollowers(const Patch& patch, const mpm::solid::Material&, const Settings& settings, const Boxes<D>& boxes,
                   ParticleView<const Vec<D>> before, ParticleView<Vec<D>> ahead) {
  const Followers<D> followers(patch.level(), settings.gas.gas, boxes);
  boxes.x.template forEachOccupied<D>(patch.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    const bool areNear = followers.areNear(cell);
    for (const int p : range) ahead[p] = areNear ? followers.aheadOf(cell, p, before[p]) : Vec<D>::Zero();
  });
}

/// The boxes that cross open sides of the grid in a step.
///
/// In place of particles that have left, those behind them have copies ahead, at the distance of an edge. A copy fills
/// space and sweeps it like a box. What bodies fill of a cell, and what leaves it, change by the same amount, also
/// where a copy replaces a particle that leaves. So a body and gas that move alike leave the grid without a change of
/// pressure. Along an axis with one cell, nothing is measured.
template <int D>
class LeavingBoxes {
 public:
  LeavingBoxes(const Patch& patch, const std::optional<CellView<Vec<D>>>& leaving)
      : level_(patch.level()), leaving_(leaving) {
    if (!leaving_) return;
    leaving_->fill(Vec<D>::Zero());
    const Box &grid = level_.cells(), &cells = patch.cells();
    Box around = cells;
    bool any = false;
    for (int d = 0; d < D; ++d) {
      if (level_.isPeriodic(d) || grid.extent(d) < 2) continue;
      touches_[d] = {cells.lower[d] == grid.lower[d], cells.upper[d] == grid.upper[d]};
      if (touches_[d][1]) ++around.upper[d];
      any = any || touches_[d][0] || touches_[d][1];
    }
    if (!any) return;
    volume_.resize(around.size());
    shift_.resize(around.size());
    faces_.emplace(SweptFaces<D>{{volume_.data(), around}, {shift_.data(), around}});
    sweeps_.emplace(*faces_);
  }

  /// Whether boxes of a cell may reach a side of the grid that the patch touches.
  bool areNear(const Index<D>& cell) const {
    bool near = false;
    for (int d = 0; d < D && sweeps_; ++d) {
      near |= touches_[d][0] && cell[d] < level_.cells().lower[d] + boxReach;
      near |= touches_[d][1] && cell[d] >= level_.cells().upper[d] - boxReach;
    }
    return near;
  }
  /// Calls `visit(copy)` for a box, and for its copies in the directions `ahead`.
  template <class Visit>
  static void forEachCopy(const Move<D>& of, const Vec<D>& ahead, Visit&& visit) {
    Box ways{{}, Index3::filled(1)};  // along each axis: 0, or 1 for a copy
    for (int d = 0; d < D; ++d) ways.upper[d] = ahead[d] != 0 ? 2 : 1;
    forEach<D>(ways, [&](const Index<D>& way) {
      Move<D> copy = of;
      for (ParticleBox<D>& box : copy)
        for (int d = 0; d < D; ++d)
          if (way[d] == 1) box.middle[d] += ahead[d] * box.edges[d];
      visit(std::as_const(copy));
    });
  }
  /// Adds the volume that a box, whose coordinates are relative to the cell `origin`, sweeps through sides.
  void sweep(const Index<D>& origin, const Move<D>& of) { sweeps_->add(origin, of[0], of[1]); }
  /// Adds the volume of a box times a factor to what leaves along an axis.
  void leave(const Index<D>& origin, const ParticleBox<D>& box, int axis, double factor) {
    if (!(box.edges.minCoeff() > 0)) return;
    forEach<D>(cellsIn(*leaving_, origin, box.reach()), [&](const Index<D>& cell) {
      const bool isAtSide = cell[axis] == level_.cells().lower[axis] || cell[axis] == level_.cells().upper[axis] - 1;
      double volume = isAtSide ? factor : 0;
      for (int d = 0; d < D; ++d) volume *= box.lengthIn(d, cell[d] - origin[d]);
      (*leaving_)[cell][axis] += volume;
    });
  }
  /// Adds what was swept through the sides to what leaves.
  void settle(const Patch& patch) const {
    if (!sweeps_) return;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        if (!touches_[d][side]) continue;
        Box edge = patch.cells();
        (side == 0 ? edge.upper[d] : edge.lower[d]) = side == 0 ? edge.lower[d] + 1 : edge.upper[d] - 1;
        forEach<D>(edge, [&](const Index<D>& cell) {
          const double up = faces_->volume[side == 0 ? cell : cell + Index<D>::unit(d)][d];
          (*leaving_)[cell][d] += side == 0 ? -up : up;
        });
      }
  }

 private:
  const Level& level_;
  std::optional<CellView<Vec<D>>> leaving_;
  std::array<std::array<bool, 2>, D> touches_{};  ///< whether the patch touches the sides
  std::vector<Vec<D>> volume_, shift_;
  std::optional<SweptFaces<D>> faces_;  ///< of the cells of the patch, and of those beyond upper sides
  std::optional<Sweeps<D>> sweeps_;
};

}  // namespace tushar::mpmice
