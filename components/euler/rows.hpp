#pragma once

#include <vector>

#include "components/euler/gas.hpp"
#include "core/core.hpp"

namespace tushar::euler {

/// The address of a row of `count` cells of a view; in builds with checks, both ends are checked.
template <int D, class T>
T* rowOf(const CellView<T>& view, Index<D> first, int count) {
  T* row = &view[first];
  first[0] += count - 1;
  static_cast<void>(view[first]);
  return row;
}

/// Largest number of cells of a block of work: the block and its surroundings fit into the second-level cache.
template <int D>
inline constexpr Index3 kBlock = D == 1   ? Index3{{256, 1, 1}}
                                 : D == 2 ? Index3{{128, 16, 1}}
                                          : Index3{{64, 8, 8}};

/// A box with the size of the largest block of a box.
template <int D>
Box largestBlock(Box box) {
  for (int d = 0; d < D; ++d) box.upper[d] = std::min(box.lower[d] + kBlock<D>[d], box.upper[d]);
  return box;
}

/// Calls `visit(block)` for boxes that tile the box, none larger than kBlock.
template <int D, class Visit>
void forEachBlock(const Box& box, Visit&& visit) {
  Box blocks{{}, Index3::filled(1)};
  for (int d = 0; d < D; ++d) blocks.upper[d] = (box.extent(d) + kBlock<D>[d] - 1) / kBlock<D>[d];
  forEach<D>(blocks, [&](const Index<D>& at) {
    Box block = box;
    for (int d = 0; d < D; ++d) {
      block.lower[d] = box.lower[d] + at[d] * kBlock<D>[d];
      block.upper[d] = std::min(block.lower[d] + kBlock<D>[d], box.upper[d]);
    }
    visit(block);
  });
}

/// One State of K gases per cell of a box, each number in an array of its own, the first axis fastest.
template <int D, int K = 1>
class Rows {
 public:
  static constexpr std::size_t numbers = std::tuple_size_v<State<D, K>>;
  using Pointers = std::array<double*, numbers>;

  /// Room for boxes of up to `cells` cells.
  explicit Rows(std::size_t cells) : cells_(cells), values_(cells * numbers) {}

  /// Sets the box that the rows hold.
  void hold(const Box& box) {
    box_ = box;
    stride_ = {1, box.extent(0), static_cast<std::ptrdiff_t>(box.extent(0)) * box.extent(1)};
  }
  const Box& box() const { return box_; }
  /// Distance in memory of neighbours along an axis.
  std::ptrdiff_t stride(int axis) const { return stride_[axis]; }

  /// Pointers to the numbers of a cell, which are followed by those of the next cell of its row.
  Pointers at(const Index<D>& cell) {
    const std::ptrdiff_t offset = offsetOf(cell);
    Pointers pointers;
    for (std::size_t k = 0; k < numbers; ++k) pointers[k] = values_.data() + k * cells_ + offset;
    return pointers;
  }
  /// One number of a cell, and all of them.
  double number(const Index<D>& cell, std::size_t k) const { return values_[k * cells_ + offsetOf(cell)]; }
  State<D, K> state(const Index<D>& cell) const {
    State<D, K> state;
    for (std::size_t k = 0; k < numbers; ++k) state[k] = number(cell, k);
    return state;
  }

 private:
  std::ptrdiff_t offsetOf(const Index<D>& cell) const {
    std::ptrdiff_t offset = 0;
    for (int d = 0; d < D; ++d) offset += (cell[d] - box_.lower[d]) * stride(d);
    return offset;
  }

  std::size_t cells_;
  std::vector<double> values_;
  Box box_;
  std::array<std::ptrdiff_t, 3> stride_{};
};

/// The State at place `i` of rows.
template <int D, std::size_t N>
std::array<double, N> load(const std::array<double*, N>& rows, std::ptrdiff_t i) {
  std::array<double, N> state;
  for (std::size_t k = 0; k < state.size(); ++k) state[k] = rows[k][i];
  return state;
}
template <int D, std::size_t N>
void store(const std::array<double*, N>& rows, std::ptrdiff_t i, const std::array<double, N>& state) {
  for (std::size_t k = 0; k < state.size(); ++k) rows[k][i] = state[k];
}

}  // namespace tushar::euler
