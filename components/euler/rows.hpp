#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "components/euler/gas.hpp"
#include "core/base/lanes.hpp"
#include "core/core.hpp"

namespace tushar::euler {

/// The address of a row of `count` cells in a view. Builds with checks check both ends of the row.
template <int D, class T>
T* rowOf(const CellView<T>& view, Index<D> first, int count) {
  T* row = &view[first];
  first[0] += count - 1;
  static_cast<void>(view[first]);
  return row;
}

/// Number of cells of a large block of work along each axis: the block and its surroundings fit into the second-level
/// cache.
template <int D>
inline constexpr Index3 kBlock = D == 1   ? Index3{{256, 1, 1}}
                                 : D == 2 ? Index3{{128, 16, 1}}
                                          : Index3{{64, 8, 8}};

/// Largest number of cells along x of a column of work: long rows are read from memory faster than short ones.
inline constexpr int kColumnWidth = 128;
/// Number of cells in a plane of a column of work, including ghosts. With it, the planes of a column that are in use
/// fit into the second-level cache or, where that is small, nearly.
inline constexpr int kColumnCells = 3000;

/// The extents of the blocks that tile a box. In two dimensions, blocks of narrow boxes are taller: with two layers of
/// ghost cells around it, a block has as many cells as one of kBlock. So fewer cells are also ghosts of another block.
template <int D>
Index3 blockOf(const Box& box) {
  Index3 block = kBlock<D>;
  if constexpr (D == 2) {
    constexpr int around = 4, cells = (kBlock<2>[0] + around) * (kBlock<2>[1] + around);
    const int width = std::clamp(box.extent(0), 1, block[0]), height = std::max(box.extent(1), 1);
    const int most = std::max(cells / (width + around) - around, block[1]);
    const int parts = (height - 1) / most + 1;
    block = {{width, (height - 1) / parts + 1, 1}};
  }
  return block;
}

/// A box as large as the largest block into which forEachBlock divides `box`.
template <int D>
Box largestBlock(Box box) {
  const Index3 block = blockOf<D>(box);
  for (int d = 0; d < D; ++d) box.upper[d] = std::min(box.lower[d] + block[d], box.upper[d]);
  return box;
}

/// Calls `visit(block)` for blocks that tile the box, none larger than `extents`.
template <int D, class Visit>
void forEachBlock(const Box& box, const Index3& extents, Visit&& visit) {
  Box blocks{{}, Index3::filled(1)};
  for (int d = 0; d < D; ++d) blocks.upper[d] = (box.extent(d) + extents[d] - 1) / extents[d];
  forEach<D>(blocks, [&](const Index<D>& at) {
    Box block = box;
    for (int d = 0; d < D; ++d) {
      block.lower[d] = box.lower[d] + at[d] * extents[d];
      block.upper[d] = std::min(block.lower[d] + extents[d], box.upper[d]);
    }
    visit(block);
  });
}
/// Calls `visit(block)` for blocks of work, with the extents blockOf(box), that tile the box.
template <int D, class Visit>
void forEachBlock(const Box& box, Visit&& visit) {
  forEachBlock<D>(box, blockOf<D>(box), std::forward<Visit>(visit));
}

/// The extents of columns along z that tile a box. Along y, a column is as wide as kColumnCells allows with `reach`
/// ghost cells on each side.
inline Index3 columnOf(const Box& box, int reach) {
  const int width = std::min(kColumnWidth, box.extent(0));
  return {{width, std::clamp(kColumnCells / (width + 2 * reach) - 2 * reach, 1, box.extent(1)), box.extent(2)}};
}

/// Uninitialised memory for numbers that are all written before they are read.
template <class T>
struct Unfilled : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = Unfilled<U>;
  };
  template <class U, class... From>
  void construct(U* at, From&&... from) {
    if constexpr (sizeof...(From) > 0)
      ::new (static_cast<void*>(at)) U(std::forward<From>(from)...);
    else
      ::new (static_cast<void*>(at)) U;
  }
};

/// One State of K gases per cell of a box. Each component is in a separate array, with the first axis fastest.
///
/// For a three-dimensional box, it may have space for only a few consecutive planes of z. A new plane then replaces the
/// plane that lies this number of planes before or behind it.
template <int D, int K = 1>
class Rows {
 public:
  static constexpr std::size_t numbers = std::tuple_size_v<State<D, K>>;
  using Pointers = std::array<double*, numbers>;

  /// Allocates space for boxes of up to `cells` cells or, in three dimensions, for `planes` planes perpendicular to z
  /// with up to `cells` cells each. The initial values are 0 or undefined.
  explicit Rows(std::size_t cells, int planes = 0) : Rows(cells, planes, Values(room(cells, planes), 0.0)) {}
  static Rows unfilled(std::size_t cells, int planes = 0) { return {cells, planes, Values(room(cells, planes))}; }

  /// Number of cells for which there is space.
  std::size_t room() const { return cells_; }
  /// Sets the box of cells that the rows contain.
  void hold(const Box& box) {
    box_ = box;
    stride_ = {1, box.extent(0), static_cast<std::ptrdiff_t>(box.extent(0)) * box.extent(1)};
  }
  const Box& box() const { return box_; }
  /// Distance in memory between neighbours along an axis; undefined along z if only some planes are stored.
  std::ptrdiff_t stride(int axis) const { return stride_[axis]; }

  /// Pointers to the components of a cell. Those of the next cells of its row follow in memory.
  Pointers at(const Index<D>& cell) {
    const std::ptrdiff_t offset = offsetOf(cell);
    Pointers pointers;
    for (std::size_t k = 0; k < numbers; ++k) pointers[k] = values_.data() + k * cells_ + offset;
    return pointers;
  }
  /// The array of a component, and the place of a cell in each array.
  const double* component(std::size_t k) const { return values_.data() + k * cells_; }
  std::ptrdiff_t offsetOf(const Index<D>& cell) const {
    std::ptrdiff_t offset = 0;
    for (int d = 0; d < D; ++d) {
      const int from = cell[d] - box_.lower[d];
      offset += (d == 2 && planes_ > 0 ? from % planes_ : from) * stride(d);
    }
    return offset;
  }
  /// One component of a cell, and all components.
  double number(const Index<D>& cell, std::size_t k) const { return values_[k * cells_ + offsetOf(cell)]; }
  State<D, K> state(const Index<D>& cell) const {
    State<D, K> state;
    const double* first = values_.data() + offsetOf(cell);
    for (std::size_t k = 0; k < numbers; ++k) state[k] = first[k * cells_];
    return state;
  }

 private:
  using Values = std::vector<double, Unfilled<double>>;

  Rows(std::size_t cells, int planes, Values values)
      : cells_(cells * std::max(planes, 1)), values_(std::move(values)), planes_(planes) {}
  static std::size_t room(std::size_t cells, int planes) { return cells * std::max(planes, 1) * numbers; }

  std::size_t cells_;
  Values values_;
  int planes_ = 0;  ///< number of planes stored; 0: all
  Box box_;
  std::array<std::ptrdiff_t, 3> stride_{};
};

/// Largest number of cells in a stretch: what a step computes for them fits into the first-level cache.
inline constexpr int kStretch = 128;

/// Whether the rows of `box` are computed faster one by one than in stretches, given that memory contains the larger
/// box `held`. This is so if a row fills whole vector registers, and the cells between two rows would take further
/// ones.
inline bool fillRegisters(const Box& box, const Box& held) {
  constexpr int lanes = Lanes::count;
  return box.extent(0) % lanes == 0 && held.extent(0) - box.extent(0) >= lanes;
}

/// Calls `visit(first, count)` for stretches of memory that contain the cells of `box`, given that memory contains the
/// larger box `held`. A stretch may contain several short rows and the cells between them, so that loops are long.
template <int D, class Visit>
void forEachStretch(const Box& box, const Box& held, Visit&& visit) {
  if (box.empty()) return;
  Box planes = box.rowStarts();
  planes.upper[1] = planes.lower[1] + 1;
  const int cells = (box.extent(1) - 1) * held.extent(0) + box.extent(0);
  const int parts = (cells - 1) / kStretch + 1, length = ((cells - 1) / parts / 8 + 1) * 8;
  forEach<D>(planes, [&](Index<D> first) {
    for (int done = 0; done < cells; done += length, first[0] += length) visit(first, std::min(length, cells - done));
  });
}

/// The number at an address or, for Lanes, the numbers that begin there.
template <class Number>
[[gnu::always_inline]] inline Number numberAt(const double* from) {
  if constexpr (std::is_same_v<Number, Lanes>)
    return Lanes::at(from);
  else
    return *from;
}
[[gnu::always_inline]] inline void put(double number, double* to) { *to = number; }
[[gnu::always_inline]] inline void put(const Lanes& numbers, double* to) { numbers.copyTo(to); }

/// The State at position `i` of rows or, for Lanes, the states that begin there.
template <int D, class Number = double, std::size_t N>
[[gnu::always_inline]] inline std::array<Number, N> load(const std::array<double*, N>& rows, std::ptrdiff_t i) {
  std::array<Number, N> state;
#pragma GCC unroll 16
  for (std::size_t k = 0; k < N; ++k) state[k] = numberAt<Number>(rows[k] + i);
  return state;
}
template <int D, class Number = double, std::size_t N>
[[gnu::always_inline]] inline void store(const std::array<double*, N>& rows, std::ptrdiff_t i,
                                         const std::array<Number, N>& state) {
#pragma GCC unroll 16
  for (std::size_t k = 0; k < N; ++k) put(state[k], rows[k] + i);
}

/// Calls `visit(number, i)` for positions `i` that together cover a row of `count` cells: Lanes::count cells at a time,
/// with a number of type Lanes. If `count` is not a multiple of this, the last positions overlap those before, so
/// `visit` must not write what it reads. Shorter rows are visited cell by cell, with a number of type double.
template <class Visit>
[[gnu::always_inline]] inline void forEachRegister(int count, Visit&& visit) {
  constexpr int lanes = Lanes::count;
  if (count < lanes)
    for (std::ptrdiff_t i = 0; i < count; ++i) visit(0.0, i);
  else
    for (std::ptrdiff_t i = 0; i < count; i += lanes) visit(Lanes(0.0), std::min<std::ptrdiff_t>(i, count - lanes));
}

/// Consecutive cells of a row of `count` cells, one per lane, beginning with the cell `first`. Lanes beyond the end of
/// a short row repeat its last cell.
struct LanesOfRow {
  std::ptrdiff_t first, count;

  /// The numbers of the cells, from a row that has one per cell.
  [[gnu::always_inline]] Lanes at(const double* row) const { return vectorsAt<1>(row)[0]; }
  /// The vectors of the cells, from a row that has D numbers per cell.
  template <int D>
  [[gnu::always_inline]] std::array<Lanes, D> vectorsAt(const double* row) const {
    if (count >= Lanes::count) return unpack<D>(row + first * D);
    std::array<Lanes, D> all;
    for (int d = 0; d < D; ++d)
      all[d] = Lanes::of([&](std::ptrdiff_t lane) { return row[std::min(lane, count - 1) * D + d]; });
    return all;
  }
};

/// The greatest of numbers of the cells of a box, or 0 if none is positive. `numbersOf(first, count)` returns a
/// function for a row of cells: it returns the numbers of the cells of a LanesOfRow.
template <int D, class NumbersOf>
double greatestInRows(const Box& box, NumbersOf&& numbersOf) {
  Lanes most = 0;
  forEachRow<D>(box, [&](const Index<D>& row, int count) {
    auto numbers = numbersOf(row, count);
    for (std::ptrdiff_t i = 0; i < count; i += Lanes::count) {
      const std::ptrdiff_t last = std::max(count - Lanes::count, 0);
      most = max(most, numbers(LanesOfRow{std::min(i, last), count}));
    }
  });
  return greatest(most);
}

}  // namespace tushar::euler
