#pragma once

#include <algorithm>
#include <array>
#include <cstring>

#include "components/mpm/gas/conserving/rows.hpp"

namespace tushar::mpm::gas::conserving {

/// The velocity modes (see Modes) of the particles of a batch, one particle per lane.
template <int D>
using LanesModes = LanesMatrix<D, (1 << D) - 1>;

/// Particles in lanes, at most one from each cell: lane k belongs to the k-th cell of a row that begins at `start`. So
/// the values that the particles read from the grid or add to it are consecutive in memory. Lanes not in use repeat
/// another particle.
template <int D>
struct Batch {
  Index<D> start;                    ///< cell of the first lane
  LaneIntegers place;                ///< indices of the particles
  std::array<LaneIntegers, D> cell;  ///< cells of the particles
  Lanes::Mask used;
  bool isFull;        ///< whether all lanes are in use
  bool isContiguous;  ///< whether the particles are consecutive in memory

  /// Constructs a batch of the particles with the indices `places`, in the lanes `takes`.
  [[gnu::always_inline]] Batch(const Index<D>& first, const LaneIntegers& places, const Lanes::Mask& takes)
      : start(first), place(places), used(takes), isFull(all(used)) {
    for (std::size_t d = 0; d < D; ++d) cell[d] = LaneIntegers{} + first[static_cast<int>(d)];
    cell[0] += ascending();
    if (!isFull) repeat();
    const LaneIntegers next = place == place[0] + ascending();
    isContiguous = isFull && all(__builtin_convertvector(next, Lanes::Mask));
  }
  /// The given values in the lanes in use, 0 in the others.
  Lanes only(const Lanes& values) const { return isFull ? values : select(used, values, 0); }
  /// Whether a condition holds in every lane in use.
  bool holds(const Lanes::Mask& mask) const { return all(mask | ~used); }

 private:
  static LaneIntegers ascending() {
    LaneIntegers lanes;
    for (int lane = 0; lane < Lanes::count; ++lane) lanes[lane] = lane;
    return lanes;
  }
  /// Copies the first particle into the lanes not in use.
  void repeat() {
    int some = 0;
    while (used[some] == 0) ++some;
    const LaneIntegers takes = __builtin_convertvector(used, LaneIntegers);
    place = takes ? place : LaneIntegers{} + place[some];
    cell[0] = takes ? cell[0] : LaneIntegers{} + cell[0][some];
  }
};

/// The first particle of each of several consecutive cells, and the end of its particles.
struct RangesOfCells {
  LaneIntegers first, last;

  /// `cells` is the number of cells; further lanes have no particles.
  RangesOfCells(const data::ParticleRange* ranges, int cells) {
    std::array<data::ParticleRange, Lanes::count> own;
    static_assert(sizeof(own) == sizeof(Pairs));
    if (cells < Lanes::count) ranges = std::copy_n(ranges, cells, own.begin()) - cells;
    Pairs pairs;
    std::memcpy(&pairs, ranges, sizeof(pairs));
    take(pairs, std::make_integer_sequence<int, Lanes::count>());
  }
  /// The largest number of particles in a cell.
  int most() const {
    int most = 0;
    while (any(__builtin_convertvector(last - first > most, Lanes::Mask))) ++most;
    return most;
  }

 private:
  using Pairs [[gnu::vector_size(2 * sizeof(LaneIntegers))]] = int;

  template <int... Lane>
  void take(const Pairs& pairs, std::integer_sequence<int, Lane...>) {
    first = __builtin_shufflevector(pairs, pairs, (2 * Lane)...);
    last = __builtin_shufflevector(pairs, pairs, (2 * Lane + 1)...);
  }
};

/// Calls `visit(batch)` for batches that contain each particle of the cells of a box once.
template <int D, class T, class Visit>
[[gnu::always_inline]] inline void forEachBatch(const Box& box, const ParticleView<T>& view, Visit&& visit) {
  forEachRow<D>(box, [&](Index<D> cell, int count) {
    const data::ParticleRange* ranges = view.set().row(cell);
    for (int done = 0; done < count; done += Lanes::count, cell[0] += Lanes::count, ranges += Lanes::count) {
      RangesOfCells particles(ranges, std::min(Lanes::count, count - done));
      for (;; particles.first += 1) {
        const auto used = __builtin_convertvector(particles.first < particles.last, Lanes::Mask);
        if (all(~used)) break;
        const Batch<D> batch(cell, particles.first, used);
        visit(batch);
      }
    }
  });
}

/// Loads a variable that has `numbers` consecutive numbers per particle, for the particles of a batch. `at(place)`
/// points to the first number of a particle.
template <int numbers, int D, class At>
[[gnu::always_inline]] inline std::array<Lanes, numbers> loadColumns(const Batch<D>& batch, At&& at) {
  if constexpr (numbers <= Lanes::count)
    if (batch.isContiguous) return unpack<numbers>(at(batch.place[0]));
  return columnsOf<numbers>([&](int lane) { return at(batch.place[lane]); });
}

template <int D>
[[gnu::always_inline]] inline Lanes load(const ParticleView<const double>& view, const Batch<D>& batch) {
  return loadColumns<1>(batch, [&](int p) { return &view[p]; })[0];
}
template <int D, int Rows, int Columns>
[[gnu::always_inline]] inline auto load(
    const ParticleView<const Eigen::Matrix<double, Rows, Columns, Eigen::DontAlign>>& view, const Batch<D>& batch) {
  return matrixOf<Rows, Columns>(loadColumns<Rows * Columns>(batch, [&](int p) { return view[p].data(); }));
}

/// Stores a variable of the particles of a batch: the inverse of loadColumns.
template <int D, std::size_t numbers, class At>
[[gnu::always_inline]] inline void storeColumns(const std::array<Lanes, numbers>& columns, const Batch<D>& batch,
                                                At&& at) {
  if constexpr (numbers <= Lanes::count)
    if (batch.isContiguous) return pack(columns, at(batch.place[0]));
  std::array<double, numbers> unused;
  storeColumns(columns, Lanes::count,
               [&](int lane) { return batch.used[lane] != 0 ? at(batch.place[lane]) : unused.data(); });
}

template <int D>
[[gnu::always_inline]] inline void store(const Lanes& values, const ParticleView<double>& view, const Batch<D>& batch) {
  storeColumns(std::array{values}, batch, [&](int p) { return &view[p]; });
}
template <int D, int Rows, int Columns>
[[gnu::always_inline]] inline void store(
    const LanesMatrix<Rows, Columns>& values,
    const ParticleView<Eigen::Matrix<double, Rows, Columns, Eigen::DontAlign>>& view, const Batch<D>& batch) {
  storeColumns(coefficientsOf<Rows, Columns>(values), batch, [&](int p) { return view[p].data(); });
}

}  // namespace tushar::mpm::gas::conserving
