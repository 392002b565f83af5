#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "components/mpmice/free_space.hpp"
#include "components/mpmice/near_bodies.hpp"
#include "components/mpmice/tasks/measure_bodies.hpp"

namespace tushar::mpmice {

/// Views of the momentum and work that the gas of each cell transfers to walls in a step, and of the flow through open
/// faces; each is empty unless something needs it.
template <int D>
struct OfferedExchange {
  std::optional<CellView<Vec<D>>> impulse;
  std::optional<CellView<double>> work;
  std::optional<CellView<Vec<D>>> massFlow;

  static OfferedExchange from(auto& take) {
    return {.impulse = take(offers(c::impulse<D>)),
            .work = take(offers(c::work)),
            .massFlow = take(offers(c::massFlow<D>))};
  }
  void clear() const {
    if (impulse) impulse->fill(Vec<D>::Zero());
    if (work) work->fill(0);
    if (massFlow) massFlow->fill(Vec<D>::Zero());
  }
};

/// Computes a sum since the start: `now` = `before` + the contribution of the step.
template <int D, class T>
void addToSum(const Patch& patch, CellView<const T> part, CellView<const T> before, CellView<T> now) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { now[cell] = before[cell] + part[cell]; });
}

/// Computes the sum of the heat since the start: from exchange coefficients and, if walls conduct, through walls.
template <int D>
void addHeatToSum(const Patch& patch, CellView<const double> heat, const std::optional<CellView<const double>>& walls,
                  CellView<const double> before, CellView<double> now) {
  forEach<D>(patch.cells(),
             [&](const Index<D>& cell) { now[cell] = before[cell] + heat[cell] + (walls ? (*walls)[cell] : 0); });
}

/// Sets the initial sum to 0.
template <int D, class T>
void startSum(const Patch&, CellView<T> sum) {
  if constexpr (std::is_same_v<T, double>)
    sum.fill(0);
  else
    sum.fill(T::Zero());
}

/// Computes the total on the patch of an amount per volume.
template <int D>
void sumOverVolume(const Patch& patch, CellView<const double> amount, Sum& sum) {
  const double volume = patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { sum.add(volume * amount[cell]); });
}
template <int D>
void sumVectorOverVolume(const Patch& patch, CellView<const Vec<D>> amount, VectorSum& sum) {
  const Level& level = patch.level();
  const double volume = level.cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!amount[cell].isZero(0)) sum.add(level.template expandDirection<D>(volume * amount[cell]));
  });
}

/// The strips of a cell along each axis that contain bodies, as bits. A cell has 1 strip in one dimension, 64 in two,
/// and 8 x 8 in three.
template <int D>
class BlockedStrips {
 public:
  static constexpr int perAxis = D == 1 ? 1 : D == 2 ? 64 : 8;
  static constexpr int count = D == 1 ? 1 : 64;

  /// Adds a box whose coordinates are measured from the lower corner of the cell.
  void add(const ParticleBox<D>& box, const Index<D>& k) {
    for (int d = 0; d < D; ++d)
      if (!(box.lengthIn(d, k[d]) > 0)) return;
    for (int axis = 0; axis < D; ++axis) {
      std::uint64_t bits = 1;
      int width = 1;
      for (int d = 0; d < D; ++d)
        if (d != axis) bits = spread(bits, width, along(box, d, k[d])), width *= perAxis;
      strips_[axis] |= bits;
    }
  }
  /// The fraction of a cell's cross-section normal to an axis that no body blocks.
  double open(int axis) const { return 1 - std::popcount(strips_[axis]) * (1.0 / count); }

 private:
  /// The strips, counted along an axis, whose centres are in the box.
  static std::uint64_t along(const ParticleBox<D>& box, int axis, int k) {
    std::uint64_t bits = 0;
    for (int i = 0; i < perAxis; ++i) {
      const double middle = k + (i + 0.5) / perAxis;
      if (std::abs(middle - box.middle[axis]) <= 0.5 * box.edges[axis]) bits |= std::uint64_t{1} << i;
    }
    return bits;
  }
  /// The pattern `bits`, which has `width` bits, repeated at each position that is set in `places`.
  static std::uint64_t spread(std::uint64_t bits, int width, std::uint64_t places) {
    std::uint64_t all = 0;
    for (int i = 0; i < perAxis; ++i)
      if (places >> i & 1) all |= bits << (i * width);
    return all;
  }

  std::array<std::uint64_t, D> strips_{};
};

/// The cells of a patch through which gas may leak in a step, and their strips that bodies block at its start.
template <int D>
class LeakyCells {
 public:
  explicit LeakyCells(const Patch& patch)
      : cells_(patch.cells()),
        around_(cells_.grown(boxReach, D)),
        numbers_(cells_.size(), none),
        is_near_(around_.size(), 0) {}

  void add(const Index<D>& cell) {
    numbers_[offsetIn<D>(cells_, cell)] = static_cast<int>(strips_.size());
    strips_.emplace_back();
    forEach<D>(cellsAround<D>(cell, boxReach), [&](const Index<D>& at) { is_near_[offsetIn<D>(around_, at)] = 1; });
  }
  /// Adds the boxes of a body.
  void block(const Level& level, const Boxes<D>& boxes) {
    if (strips_.empty()) return;
    boxes.x.template forEachOccupied<D>(boxes.x.cells(), [&](const Index<D>& origin, const data::ParticleRange& range) {
      if (!around_.contains(origin) || is_near_[offsetIn<D>(around_, origin)] == 0) return;
      const mpm::CellFrame<D> frame(level, origin);
      for (const int p : range) blockBy(origin, boxes.of(frame, p));
    });
  }
  /// Calls `visit(cell, strips)` for each of the cells.
  template <class Visit>
  void forEachCell(Visit&& visit) const {
    if (strips_.empty()) return;
    forEach<D>(cells_, [&](const Index<D>& cell) {
      const int number = numbers_[offsetIn<D>(cells_, cell)];
      if (number != none) visit(cell, strips_[static_cast<std::size_t>(number)]);
    });
  }

 private:
  static constexpr int none = -1;

  void blockBy(const Index<D>& origin, const ParticleBox<D>& box) {
    forEach<D>(box.reach(), [&](const Index<D>& k) {
      const Index<D> cell = origin + k;
      if (!cells_.contains(cell)) return;
      const int number = numbers_[offsetIn<D>(cells_, cell)];
      if (number != none) strips_[static_cast<std::size_t>(number)].add(box, k);
    });
  }

  Box cells_, around_;
  std::vector<int> numbers_;  ///< index of each cell of the patch in strips_
  std::vector<std::uint8_t> is_near_;
  std::vector<BlockedStrips<D>> strips_;
};

/// The mass that leaks through bodies along an axis in a step, per cell volume. It is the part of the gas flowing in
/// through one face and out through the other that has no straight path past the bodies in the cell.
inline double leakAlong(double in, double out, double openIn, double openOut, double straight) {
  if (!(in * out > 0)) return 0;
  const double through = std::min(std::abs(in), std::abs(out)), width = std::min(openIn, openOut);
  return width > straight ? through * (1 - straight / width) : 0;
}

/// Adds the leak of a step to the leak since the start in each cell.
template <int D>
void measureLeak(const Patch& patch, const std::vector<mpm::solid::Material>&, const std::vector<Boxes<D>>& materials,
                 const Settings& settings, const GasInCells<D>& cells, CellView<const Vec<D>> flow,
                 CellView<const double> before, CellView<double> leak) {
  const FreeSpace<D> space(patch.level(), settings, cells);
  const auto mayLeak = [&](const Index<D>& cell, int d) {
    return !space.isAtSide(cell, d, 0) && !space.isAtSide(cell, d, 1) &&
           flow[cell][d] * flow[cell + Index<D>::unit(d)][d] > 0;
  };
  LeakyCells<D> leaky(patch);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    leak[cell] = before[cell];
    if (!(cells.free[cell] < 1) || cells.isEmpty(cell)) return;
    for (int d = 0; d < D; ++d)
      if (mayLeak(cell, d)) return leaky.add(cell);
  });
  for (const Boxes<D>& boxes : materials) leaky.block(patch.level(), boxes);
  leaky.forEachCell([&](const Index<D>& cell, const BlockedStrips<D>& strips) {
    for (int d = 0; d < D; ++d) {
      if (!mayLeak(cell, d)) continue;
      const OpenFaces faces = space.faces(cell, d);
      leak[cell] +=
          leakAlong(flow[cell][d], flow[cell + Index<D>::unit(d)][d], faces.open[0], faces.open[1], strips.open(d));
    }
  });
}

/// Computes the heat from the gas to bodies in a step, on the patch [J]: from exchange coefficients and, if walls
/// conduct, through walls.
template <int D>
void sumHeatOfStep(const Patch& patch, CellView<const double> heat, const std::optional<CellView<const double>>& walls,
                   Sum& sum) {
  sumOverVolume<D>(patch, heat, sum);
  if (walls) sumOverVolume<D>(patch, *walls, sum);
}

}  // namespace tushar::mpmice
