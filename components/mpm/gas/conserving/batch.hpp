#pragma once

#include <array>

#include "core/base/lanes.hpp"
#include "core/core.hpp"

namespace tushar::mpm::gas::conserving {

/// One vector for each particle of a batch.
template <int D>
using LanesVec = Eigen::Matrix<Lanes, D, 1, Eigen::DontAlign>;
/// The velocity modes of each particle of a batch, as in Modes.
template <int D>
using LanesModes = Eigen::Matrix<Lanes, D, (1 << D) - 1, Eigen::DontAlign>;

/// Particles side by side, one per lane.
template <int D>
struct Batch {
  int count = 0;  ///< number of lanes in use; the other lanes repeat the last particle
  LaneIntegers place;
  std::array<LaneIntegers, D> cell;

  void add(int particle, const Index<D>& in) {
    place[count] = particle;
    for (int d = 0; d < D; ++d) cell[d][count] = in[d];
    ++count;
  }
  void fillUp() {
    for (int lane = count; lane < Lanes::count; ++lane) {
      place[lane] = place[lane - 1];
      for (LaneIntegers& along : cell) along[lane] = along[lane - 1];
    }
  }
  /// These values in the lanes in use, 0 in the others.
  Lanes only(const Lanes& values) const {
    return count == Lanes::count ? values : Lanes::of([&](int lane) { return lane < count ? values[lane] : 0.0; });
  }
};

/// Calls `visit(batch)` for all particles of the cells of a box, in the order of `forEach` over cells. A batch lies in
/// one row of cells.
template <int D, class T, class Visit>
void forEachBatch(const Box& box, const ParticleView<T>& view, Visit&& visit) {
  Batch<D> batch;
  const auto flush = [&] {
    batch.fillUp();
    visit(std::as_const(batch));
    batch.count = 0;
  };
  forEach<D>(box, [&](const Index<D>& cell) {
    for (const int p : view.in(cell)) {
      batch.add(p, cell);
      if (batch.count == Lanes::count) flush();
    }
    if (batch.count > 0 && cell[0] == box.upper[0] - 1) flush();
  });
}

template <int D>
Lanes load(const ParticleView<const double>& view, const Batch<D>& batch) {
  return Lanes::of([&](int lane) { return view[batch.place[lane]]; });
}
template <int D, int Rows, int Columns>
auto load(const ParticleView<const Eigen::Matrix<double, Rows, Columns, Eigen::DontAlign>>& view,
          const Batch<D>& batch) {
  Eigen::Matrix<Lanes, Rows, Columns, Eigen::DontAlign> values;
  for (int column = 0; column < Columns; ++column)
    for (int row = 0; row < Rows; ++row)
      values(row, column) = Lanes::of([&](int lane) { return view[batch.place[lane]](row, column); });
  return values;
}

template <int D>
void store(const Lanes& values, const ParticleView<double>& view, const Batch<D>& batch) {
  for (int lane = 0; lane < batch.count; ++lane) view[batch.place[lane]] = values[lane];
}
template <int D, int Rows, int Columns>
void store(const Eigen::Matrix<Lanes, Rows, Columns, Eigen::DontAlign>& values,
           const ParticleView<Eigen::Matrix<double, Rows, Columns, Eigen::DontAlign>>& view, const Batch<D>& batch) {
  for (int lane = 0; lane < batch.count; ++lane) {
    auto& target = view[batch.place[lane]];
    for (int column = 0; column < Columns; ++column)
      for (int row = 0; row < Rows; ++row) target(row, column) = values(row, column)[lane];
  }
}

}  // namespace tushar::mpm::gas::conserving
