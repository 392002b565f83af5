#pragma once

#include "components/mpmice/tasks/leaving_bodies.hpp"
#include "components/mpmice/tasks/measure_bodies.hpp"

namespace tushar::mpmice {

/// Number of layers of cells around gas in which it may follow walls through faces in a step.
inline constexpr int sweptReach = 3;

/// Views of the gas at the start of a step, as far as faces matter through which gas may follow walls.
struct GasNearby : RoomAndMass {
  static GasNearby from(auto& take) {
    return {{.free = take(requiresOld(c::freeVolume, sweptReach)), .mass = take(requiresOld(c::density, sweptReach))}};
  }
  /// Marks the cells through whose lower faces gas may follow walls.
  template <int D>
  CellMarks<D> mark(const Patch& patch) const {
    CellMarks<D> marks(patch.cells().grown(sweptReach, D));
    marks.fill(marks.box());
    const Box rows = rowsWithBodies<D>(marks.box(), sweptReach, false);
    if (!rows.empty()) markAroundGas(marks, sweptReach, rows);
    return marks;
  }
};

/// Marks the cells of a patch in `needed`, and the cells around them, also outside the patch.
template <int D>
CellMarks<D> markAround(const Patch& patch, const CellMarks<D>& needed) {
  CellMarks<D> marks(patch.cells().grown(boxReach, D));
  forEachRow<D>(patch.cells(),
                [&](const Index<D>& first, int count) { std::copy_n(needed.row(first), count, marks.row(first)); });
  marks.spread(1, marks.box());
  return marks;
}

/// Whether a box is only in its cell and the cells around it.
template <int D>
bool isClose(const ParticleBox<D>& box) {
  bool close = true;
  for (int d = 0; d < D; ++d) close = close && box.middle[d] - box.edges[d] >= -1 && box.middle[d] + box.edges[d] < 2;
  return close;
}

/// Measures the boxes of bodies in a step, those of one cell after another.
template <int D>
class MotionOfBoxes {
 public:
  MotionOfBoxes(const Patch& patch, const Settings& settings, const GasNearby& gas, const FreeShares<D>& free,
                const SweptFaces<D>& swept, const std::optional<CellView<Vec<D>>>& leaving)
      : level_(patch.level()),
        gas_(settings.gas.gas),
        taken_(free, BoxImages<D>(patch.level())),
        sweeps_(swept),
        leavers_(patch, leaving),
        needed_(gas.mark<D>(patch)),
        around_(markAround<D>(patch, needed_)) {}

  void add(const MovedBoxes<D>& boxes, const Index<D>& cell, const data::ParticleRange& range) {
    const mpm::CellFrame<D> frame(level_, cell);
    // A particle that is removed leaves its space free, like a burnt one.
    const auto remains = [&](int p) { return boxes.after.x[p][0] != data::removed; };
    for (const int p : range)
      if (remains(p)) add(boxes, cell, frame, p, [&](const Move<D>& of, auto&& visit) { visit(cell, of); });
    if (!taken_.planes().areNear(cell)) return;
    for (const int p : range)
      if (remains(p))
        add(boxes, cell, frame, p,
            [&](const Move<D>& of, auto&& visit) { taken_.planes().template forEachOf<3>(cell, of, visit); });
  }
  void settle(const Patch& patch) {
    taken_.settle();
    leavers_.settle(patch);
    sweeps_.settle(needed_);
  }

 private:
  /// Adds a particle. `forEachImage(move, visit)` calls `visit(cell, image)` for its box, or for its mirror images.
  template <class ForEachImage>
  void add(const MovedBoxes<D>& boxes, const Index<D>& cell, const mpm::CellFrame<D>& frame, int p,
           ForEachImage&& forEachImage) {
    const Move<D> of = boxes.of(frame, p);
    const bool isNearGas = around_(cell);
    const auto sweep = [&](const Index<D>& from, const Move<D>& move) {
      if (isNearGas || !isClose(move[0]) || !isClose(move[1])) sweeps_.add(from, move[0], move[1]);
    };
    const auto take = [&](const Index<D>& from, const Move<D>& move) { taken_.take(from, move[2]); };
    if (!leavers_.areNear(cell)) {
      forEachImage(of, sweep);
      return forEachImage(of, take);
    }
    const Vec<D>&before = (*boxes.aheadBefore)[p], &ahead = (*boxes.ahead)[p];
    const WayOut way = wayOut<D>(level_, gas_, cell, boxes.after.x[p]);
    const auto forEachCopy = [&](const Vec<D>& directions, auto&& visit) {
      LeavingBoxes<D>::forEachCopy(of, directions, [&](const Move<D>& copy) { forEachImage(copy, visit); });
    };
    forEachCopy(before, sweep);
    forEachCopy(before, [&](const Index<D>& from, const Move<D>& move) { leavers_.sweep(from, move); });
    if (!way.isOne()) forEachCopy(ahead, take);
    const int axis = way.isOne() ? way.axis : firstDifference(before, ahead);
    if (axis < 0) return;
    const auto leave = [&](double factor) {
      return [&, factor](const Index<D>& from, const Move<D>& move) { leavers_.leave(from, move[2], axis, factor); };
    };
    forEachCopy(before, leave(1));
    if (!way.isOne()) forEachCopy(ahead, leave(-1));
  }
  /// The first axis along which two vectors differ, or -1.
  static int firstDifference(const Vec<D>& a, const Vec<D>& b) {
    for (int d = 0; d < D; ++d)
      if (a[d] != b[d]) return d;
    return -1;
  }

  const Level& level_;
  const euler::Gas& gas_;
  TakenShares<D> taken_;
  Sweeps<D> sweeps_;
  LeavingBoxes<D> leavers_;
  CellMarks<D> needed_, around_;
};

/// Measures the bodies at the end of a step, before relocation, and the volume of bodies that passed through faces near
/// gas, and that left the grid. For the latter, each box keeps the shape that it had at the start of the step.
template <int D>
void measureMotion(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                   const GasNearby& gas, const std::vector<MovedBoxes<D>>& materials, const FreeShares<D>& free,
                   const SweptFaces<D>& swept, const std::optional<CellView<Vec<D>>>& leaving) {
  MotionOfBoxes<D> motion(patch, settings, gas, free, swept, leaving);
  for (const MovedBoxes<D>& boxes : materials) {
    const ParticleView<const Vec<D>>& x = boxes.before.x;
    x.template forEachOccupied<D>(
        x.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) { motion.add(boxes, cell, range); });
  }
  motion.settle(patch);
  fillOutside<D>(patch.level(), free, narrowFreeVolume);
}

}  // namespace tushar::mpmice
