#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/lanes.hpp"
#include "core/core.hpp"

namespace tushar::mpm::gas::conserving {

/// Memory that a thread has used for AlignedNumbers, kept for the next ones if it is small.
class KeptNumbers {
 public:
  struct Block {
    std::unique_ptr<double[]> memory;
    std::size_t size = 0;
  };

  static KeptNumbers& ofThread() {
    static thread_local KeptNumbers kept;
    return kept;
  }
  /// A block of at least `size` numbers: the smallest kept one if it is not much larger, or a new one. What is kept is
  /// cleared first: other data, read as numbers, may be denormal, with which processors are slow.
  Block take(std::size_t size) {
    auto best = blocks_.end();
    for (auto it = blocks_.begin(); it != blocks_.end(); ++it)
      if (it->size >= size && it->size <= 2 * size && (best == blocks_.end() || it->size < best->size)) best = it;
    if (best == blocks_.end()) {
      const bool isKept = size <= largest;
      return {isKept ? std::make_unique<double[]>(size) : std::make_unique_for_overwrite<double[]>(size), size};
    }
    Block found = std::exchange(*best, std::move(blocks_.back()));
    blocks_.pop_back();
    return found;
  }
  void giveBack(Block&& block) {
    if (block.size <= largest && blocks_.size() < most) blocks_.push_back(std::move(block));
  }

 private:
  static constexpr std::size_t largest = 1 << 12, most = 8;  ///< numbers in a block that is kept; blocks

  KeptNumbers() { blocks_.reserve(most); }

  std::vector<Block> blocks_;
};

/// Numbers with the values that the memory happens to contain. The first one begins a cache line, so that whole
/// registers of them never lie in two lines.
class AlignedNumbers {
 public:
  AlignedNumbers() = default;
  explicit AlignedNumbers(std::size_t count) : block_(KeptNumbers::ofThread().take(count + Lanes::count)) {
    void* start = block_.memory.get();
    std::size_t bytes = (count + Lanes::count) * sizeof(double);
    first_ = static_cast<double*>(std::align(alignof(Lanes), count * sizeof(double), start, bytes));
  }
  AlignedNumbers(AlignedNumbers&& other) noexcept { *this = std::move(other); }
  AlignedNumbers& operator=(AlignedNumbers&& other) noexcept {
    std::swap(block_, other.block_);
    std::swap(first_, other.first_);
    return *this;
  }
  ~AlignedNumbers() {
    if (block_.memory) KeptNumbers::ofThread().giveBack(std::move(block_));
  }
  double& operator[](std::size_t k) const { return first_[k]; }
  double* get() const { return first_; }

 private:
  KeptNumbers::Block block_;
  double* first_ = nullptr;
};

/// A matrix of Lanes: one matrix per lane, for several particles, cells or nodes side by side.
template <int Rows, int Columns>
using LanesMatrix = Eigen::Matrix<Lanes, Rows, Columns, Eigen::DontAlign>;
/// One vector in each lane.
template <int D>
using LanesVec = LanesMatrix<D, 1>;
/// One tensor in each lane.
template <int D>
using LanesTensor = LanesMatrix<D, D>;

/// A matrix with these coefficients, in the order in which Eigen stores them.
template <int Rows, int Columns>
[[gnu::always_inline]] inline LanesMatrix<Rows, Columns> matrixOf(const std::array<Lanes, Rows * Columns>& columns) {
  LanesMatrix<Rows, Columns> values;
  for (int k = 0; k < Rows * Columns; ++k) values(k % Rows, k / Rows) = columns[static_cast<std::size_t>(k)];
  return values;
}
/// The coefficients of a matrix, in the order in which Eigen stores them: the inverse of matrixOf.
template <int Rows, int Columns>
[[gnu::always_inline]] inline std::array<Lanes, Rows * Columns> coefficientsOf(
    const LanesMatrix<Rows, Columns>& values) {
  std::array<Lanes, Rows * Columns> columns;
  for (int k = 0; k < Rows * Columns; ++k) columns[static_cast<std::size_t>(k)] = values(k % Rows, k / Rows);
  return columns;
}

/// Consecutive cells or nodes of a row, one per lane; lanes beyond `count` repeat the last one.
template <int D>
struct RowPart {
  Index<D> first;
  int count;

  bool isFull() const { return count == Lanes::count; }
  Index<D> at(int lane) const {
    Index<D> index = first;
    index[0] += std::min(lane, count - 1);
    return index;
  }
  RowPart operator+(const Index<D>& by) const { return {first + by, count}; }
};

/// Calls `visit(part)` for the cells or nodes of a box, row by row.
template <int D, class Visit>
[[gnu::always_inline]] inline void forEachRowPart(const Box& box, Visit&& visit) {
  forEachRow<D>(box, [&](Index<D> first, int count) {
    for (; count > 0; count -= Lanes::count, first[0] += Lanes::count)
      visit(RowPart<D>{first, std::min(count, Lanes::count)});
  });
}

/// Visits the nodes of a box: `inside(part)` row by row those whose cells are all in `cells`, `atRim(node)` each other
/// node.
template <int D, class Inside, class AtRim>
[[gnu::always_inline]] inline void forEachNodeOf(const Box& nodes, const Box& cells, Inside&& inside, AtRim&& atRim) {
  forEachRow<D>(nodes, [&](Index<D> node, int count) {
    bool isInside = true;
    for (int d = 1; d < D; ++d) isInside = isInside && node[d] > cells.lower[d] && node[d] < cells.upper[d];
    const int end = node[0] + count;
    const int first = isInside ? std::min(std::max(node[0], cells.lower[0] + 1), end) : end;
    const int last = isInside ? std::max(std::min(end, cells.upper[0]), first) : end;
    for (; node[0] < first; ++node[0]) atRim(std::as_const(node));
    for (; node[0] < last; node[0] += Lanes::count) inside(RowPart<D>{node, std::min(last - node[0], Lanes::count)});
    for (node[0] = last; node[0] < end; ++node[0]) atRim(std::as_const(node));
  });
}

template <int D, data::Centring C>
[[gnu::always_inline]] inline Lanes load(const data::GridView<C, const double>& view, const RowPart<D>& part) {
  if (part.isFull()) return Lanes::at(&view[part.first]);
  return Lanes::of([&](int lane) { return view[part.at(lane)]; });
}
template <int D, data::Centring C, int Rows, int Columns>
[[gnu::always_inline]] inline LanesMatrix<Rows, Columns> load(
    const data::GridView<C, const Eigen::Matrix<double, Rows, Columns, Eigen::DontAlign>>& view,
    const RowPart<D>& part) {
  constexpr int numbers = Rows * Columns;
  if constexpr (numbers <= Lanes::count)
    if (part.isFull()) return matrixOf<Rows, Columns>(unpack<numbers>(view[part.first].data()));
  return matrixOf<Rows, Columns>(columnsOf<numbers>([&](int lane) { return view[part.at(lane)].data(); }));
}
template <int D, data::Centring C>
[[gnu::always_inline]] inline void store(const Lanes& values, const data::GridView<C, double>& view,
                                         const RowPart<D>& part) {
  if (part.isFull()) return values.copyTo(&view[part.first]);
  for (int lane = 0; lane < part.count; ++lane) view[part.at(lane)] = values[lane];
}
template <int D, data::Centring C, int Rows, int Columns>
[[gnu::always_inline]] inline void store(
    const LanesMatrix<Rows, Columns>& values,
    const data::GridView<C, Eigen::Matrix<double, Rows, Columns, Eigen::DontAlign>>& view, const RowPart<D>& part) {
  const auto columns = coefficientsOf<Rows, Columns>(values);
  if constexpr (Rows * Columns <= Lanes::count)
    if (part.isFull()) return pack(columns, view[part.first].data());
  storeColumns(columns, part.count, [&](int lane) { return view[part.at(lane)].data(); });
}

}  // namespace tushar::mpm::gas::conserving
