#pragma once

#include <array>

#include "components/mpmice/box_images.hpp"
#include "components/mpmice/gas_in_cells.hpp"
#include "components/mpmice/near_bodies.hpp"

namespace tushar::mpmice {

/// Open fraction of a face between two cells with gas. Bodies cover the fraction `coverage` of the face, and leave the
/// volume fractions `below` and `above` of the two cells free. At most eight times the free volume beside the face is
/// open, so that gas cannot rush out of a cell that is almost full.
inline double openShare(double coverage, double below, double above, bool thinWalls) {
  double most = 8 * std::min(below, above);
  if (thinWalls) most = std::min(most, std::max(0.0, 1 - 4 * ((1 - below) + (1 - above))));
  return std::max(0.0, std::min(1 - coverage, most));
}

/// The open parts and walls at a cell's two faces along an axis, as fractions of the face area.
struct OpenFaces {
  std::array<double, 2> open{};
  double area = 0;  ///< open part and wall together, equal for both faces; 0 if the cell has no gas

  double wall(int side) const { return area - open[side]; }
};

/// The degree to which the walls of a cell face in one direction: 1 for one plane wall, 0 for two walls that face each
/// other.
template <int D>
double facingOneWay(const Level& level, const std::array<OpenFaces, D>& faces) {
  double open = 0, all = 0;
  for (int d = 0; d < D; ++d) {
    const double tilt = (faces[d].open[1] - faces[d].open[0]) * level.inverseSpacing(d);
    const double walls = (2 * faces[d].area - faces[d].open[1] - faces[d].open[0]) * level.inverseSpacing(d);
    open += tilt * tilt;
    all += walls * walls;
  }
  return all > 0 ? std::min(1.0, std::sqrt(open / all)) : 0;
}

/// The cell itself or, if it is outside the grid, the nearest cell on the grid.
template <int D>
Index<D> nearestOnGrid(const Level& level, Index<D> cell) {
  for (int d = 0; d < D; ++d)
    if (!level.isPeriodic(d)) cell[d] = std::clamp(cell[d], level.cells().lower[d], level.cells().upper[d] - 1);
  return cell;
}

/// The space available to the gas: the free volumes of cells and the open fractions of faces, which bodies leave.
///
/// A face is open if there is gas on both sides or, if the gas can expand without limit (Settings::fillsVacuum), on one
/// side. A face that is not completely open has a wall on the rest of its area. Along each axis, a cell has the same
/// area, open and wall together, on both sides, so that a gas at rest exerts no force.
template <int D>
class FreeSpace {
 public:
  FreeSpace(const Level& level, const Settings& settings, const GasInCells<D>& cells)
      : level_(&level), thin_walls_(settings.thinWalls), fills_vacuum_(settings.fillsVacuum()), cells_(cells) {
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) is_plane_[d][side] = isPlane(level, d, side);
  }

  /// Measures the open fractions of faces near bodies all at once, for tasks that ask for them often.
  void measure(const NearBodies<D>& near);

  bool isEmpty(const Index<D>& cell) const { return cells_.isEmpty(cell); }
  /// Whether a cell has no gas, but gas may flow in.
  bool isVacuum(const Index<D>& cell) const {
    return fills_vacuum_ && isEmpty(cell) && !(cells_.free[cell] < leastFreeVolume);
  }
  /// Whether the lower (0) or upper (1) face of a cell is on a side of the grid.
  bool isAtSide(const Index<D>& cell, int axis, int side) const {
    if (level_->isPeriodic(axis)) return false;
    return side == 0 ? cell[axis] == level_->cells().lower[axis] : cell[axis] == level_->cells().upper[axis] - 1;
  }

  /// Whether there are cells of the grid on both sides of the lower face of a cell.
  bool isInGrid(const Index<D>& cell, int axis) const {
    return level_->isPeriodic(axis) ||
           (cell[axis] > level_->cells().lower[axis] && cell[axis] < level_->cells().upper[axis]);
  }

  /// The cell itself or, if it is outside the grid, the nearest cell on the grid.
  Index<D> onGrid(const Index<D>& cell) const { return nearestOnGrid(*level_, cell); }

  /// Open fraction of a face.
  double aperture(const Index<D>& cell, int axis, int side) const {
    if (isAtSide(cell, axis, side)) return isEmpty(cell) ? 0 : openAtSide(cell, axis, side);
    const Index<D> above = side == 0 ? cell : cell + Index<D>::unit(axis), below = above - Index<D>::unit(axis);
    if (measured_.contains(above)) return open_[axis][offsetIn<D>(measured_, above)];
    if (!mayPass(below, above)) return 0;
    return openShare(cells_.coverage[above][axis], roomOf(cells_.free[below]), roomOf(cells_.free[above]), thin_walls_);
  }
  /// Whether bodies leave the lower face of a cell and the cells on both sides of it completely free, so that the face
  /// has no wall. Faces on sides of the grid, or beyond, are never reported as open.
  bool isOpen(const Index<D>& cell, int axis) const {
    const Index<D> below = cell - Index<D>::unit(axis);
    if (!isInGrid(cell, axis)) return false;
    const bool isCovered = 1 - cells_.coverage[cell][axis] < 1;  // by more than round-off, as in openShare
    return isWhole(below) && isWhole(cell) && !isCovered;
  }
  /// Whether all faces of a cell are open.
  bool isOpenAround(const Index<D>& cell) const {
    bool all = true;
    for (int d = 0; d < D; ++d) all = all && isOpen(cell, d) && isOpen(cell + Index<D>::unit(d), d);
    return all;
  }
  OpenFaces faces(const Index<D>& cell, int axis) const {
    if (isEmpty(cell)) return {};
    OpenFaces both{{aperture(cell, axis, 0), aperture(cell, axis, 1)}};
    both.area = std::max(std::max(both.open[0], both.open[1]), roomOf(cells_.free[cell]));
    return both;
  }

  /// Unit vector into the body: the direction of the gradient of 1 - free volume over the surrounding cells, with the
  /// weights 1 2 1 along the axes perpendicular to each derivative; 0 if the gradient vanishes. Source: D. L. Youngs,
  /// AWRE report 44/92/35 (1984).
  Vec<D> normal(const Index<D>& cell) const { return unitAlong(differences(cell)); }
  /// The surface of the bodies in a cell: its normal, and the degree to which the walls of the cell, at these faces,
  /// are those of one oblique plane along which gas slips: that of facingOneWay. It is less if the neighbours hardly
  /// tell where the body of the cell continues, as for a grain smaller than the cell, whose normal would be that of
  /// round-off.
  struct Surface {
    Vec<D> normal = Vec<D>::Zero();
    double slip = 0;
  };
  Surface surface(const Index<D>& cell, const std::array<OpenFaces, D>& faces) const {
    constexpr double ofPlanes =
        0.25;  // the least difference per cell, in relation to what a thick body fills of a cell
    const Vec<D> change = differences(cell);
    const double filled = filledOf(cell);
    const double known = filled > 0 ? std::min(1.0, change.norm() / (ofPlanes * filled)) : 1;
    return {unitAlong(change), known * facingOneWay<D>(*level_, faces)};
  }

 private:
  /// The filled fraction of a cell; 0 if it is round-off.
  double filledOf(const Index<D>& cell) const {
    const double filled = 1 - cells_.free[cell];
    return filled > offRoundShares ? filled : 0;
  }
  /// The unit vector along a gradient with these differences per cell; 0 if there are none.
  Vec<D> unitAlong(Vec<D> gradient) const {
    for (int d = 0; d < D; ++d) gradient[d] *= level_->inverseSpacing(d);
    const double length = gradient.norm();
    return length > 0 ? Vec<D>(gradient / length) : gradient;
  }
  /// Differences of the filled fraction per cell along each axis, with the weights of normal.
  Vec<D> differences(const Index<D>& cell) const {
    Vec<D> sum = Vec<D>::Zero();
    Box around{{}, Index3::filled(1)};
    bool isInside = true;
    for (int d = 0; d < D; ++d) {
      around.upper[d] = 3;
      isInside &= !isAtSide(cell, d, 0) && !isAtSide(cell, d, 1);
    }
    forEach<D>(around, [&](const Index<D>& at) {
      const Index<D> beside = cell + at - Index<D>::filled(1);
      const double filled = filledOf(isInside ? beside : onGrid(beside));
      for (int d = 0; d < D; ++d) {
        if (at[d] == 1) continue;
        double weight = at[d] == 0 ? -1 : 1;
        for (int k = 0; k < D; ++k)
          if (k != d && at[k] == 1) weight *= 2;
        sum[d] += weight * filled;
      }
    });
    constexpr double weights = D == 1 ? 2 : D == 2 ? 8 : 32;
    return sum / weights;
  }
  /// The open fraction of a face on a side of the grid, of a cell with gas. Beyond a symmetry plane, there is the
  /// mirror image of the cell; other sides are as open as the cell.
  double openAtSide(const Index<D>& cell, int axis, int side) const {
    const double room = roomOf(cells_.free[cell]);
    if (!is_plane_[axis][side] || (side == 1 && !cells_.coverageAtEnd)) return room;
    const double covered = side == 0 ? cells_.coverage[cell][axis] : (*cells_.coverageAtEnd)[cell][axis];
    return openShare(covered, room, room, thin_walls_);
  }
  bool isWhole(const Index<D>& cell) const { return !(cells_.free[cell] < 1) && cells_.held.density[cell] > 0; }

  /// Whether gas may pass between two cells, if bodies leave an opening.
  bool mayPass(const Index<D>& below, const Index<D>& above) const {
    const bool isGasBelow = !isEmpty(below), isGasAbove = !isEmpty(above);
    return isGasBelow ? isGasAbove || isVacuum(above) : isGasAbove && isVacuum(below);
  }

  /// Stands for the room in a cell that no gas may enter. The room in a cell without gas that gas may enter has a
  /// negative sign.
  static constexpr double closed = -2;

  const Level* level_;
  bool thin_walls_, fills_vacuum_;
  std::array<std::array<bool, 2>, D> is_plane_{};  ///< whether the sides are symmetry planes
  GasInCells<D> cells_;
  Box measured_;  ///< the cells whose lower faces are measured
  /// The open fractions of these faces along each axis.
  std::array<std::vector<double, euler::Unfilled<double>>, D> open_;
};

template <int D>
void FreeSpace<D>::measure(const NearBodies<D>& near) {
  Box known = cells_.free.box().intersect(cells_.held.density.box());
  for (int d = 0; d < D; ++d) ++known.lower[d];
  measured_ = known.intersect(near.rows());
  if (measured_.empty()) return;
  Box around = measured_;
  for (int d = 0; d < D; ++d) --around.lower[d];
  std::vector<double, euler::Unfilled<double>> rooms(around.size());
  forEachRow<D>(around, [&](const Index<D>& first, int count) {
    const double *free = &cells_.free[first], *mass = &cells_.held.density[first];
    double* room = &rooms[offsetIn<D>(around, first)];
    const bool fillsVacuum = fills_vacuum_;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const double own = roomOf(free[i]), ofVacuum = fillsVacuum ? -own : closed;
      const double open = mass[i] > 0 ? own : ofVacuum;
      room[i] = free[i] < leastFreeVolume ? closed : open;
    }
  });
  for (auto& ofAxis : open_) ofAxis.resize(measured_.size());
  forEachRow<D>(measured_, [&](const Index<D>& first, int count) {
    const double* covered = cells_.coverage[first].data();
    const double* above = &rooms[offsetIn<D>(around, first)];
    for (int d = 0; d < D; ++d) {
      double* open = &open_[d][offsetIn<D>(measured_, first)];
      const double* below = &rooms[offsetIn<D>(around, first - Index<D>::unit(d))];
      const bool thin = thin_walls_;
#pragma GCC ivdep
      for (int i = 0; i < count; ++i) {
        const double share = openShare(covered[i * D + d], std::abs(below[i]), std::abs(above[i]), thin);
        const bool hasGas = std::max(below[i], above[i]) >= 0, mayPass = std::min(below[i], above[i]) > closed;
        open[i] = hasGas & mayPass ? share : 0.0;
      }
    }
  });
}

}  // namespace tushar::mpmice
