#include "core/tasks/transfer.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "core/base/limiters.hpp"

namespace tushar::tasks {

using data::Label;
using grid::Box;

namespace {

/// The values of cells in memory, and the distances in memory between neighbours.
template <class Number>
class Cells {
 public:
  Cells(const CellValues& values, int components)
      : numbers_(reinterpret_cast<Number*>(values.values)), stored_(values.stored), components_(components) {
    stride_[0] = components;
    for (int d = 1; d < 3; ++d) stride_[d] = stride_[d - 1] * stored_.extent(d - 1);
  }
  Number* at(const Index3& cell) const {
    return numbers_ + static_cast<std::ptrdiff_t>(stored_.offset(cell)) * components_;
  }
  std::ptrdiff_t stride(int axis) const { return stride_[axis]; }
  bool hasBelow(int cell, int axis) const { return cell > stored_.lower[axis]; }
  bool hasAbove(int cell, int axis) const { return cell + 1 < stored_.upper[axis]; }
  const Box& stored() const { return stored_; }

 private:
  Number* numbers_;
  Box stored_;
  std::ptrdiff_t components_;
  std::array<std::ptrdiff_t, 3> stride_{};
};

/// The means of a row of `count` cells, from their first child. `Components`: 0 if it is not known at compile time;
/// likewise `Count`, the number of cells of a short row.
template <int D, int Components, int Count = 0>
void meansOfRow(const double* child, const std::array<std::ptrdiff_t, 3>& stride, int count, int components,
                double* to) {
  const std::ptrdiff_t x = stride[0], y = stride[1], z = stride[2];
  const int numbers = Components > 0 ? Components : components, cells = Count > 0 ? Count : count;
  for (int cell = 0; cell < cells; ++cell, child += x)  // the second one along x
    for (int k = 0; k < numbers; ++k, ++child) {
      const auto pair = [&](std::ptrdiff_t beside) { return child[beside] + child[beside + x]; };
      if constexpr (D == 1) *to++ = 0.5 * pair(0);
      if constexpr (D == 2) *to++ = 0.25 * (pair(0) + pair(y));
      if constexpr (D == 3) *to++ = 0.125 * ((pair(0) + pair(y)) + (pair(z) + pair(y + z)));
    }
}

template <int D, int Components, int Count>
void meansOfRows(const Box& box, const CellValues& from, const CellValues& means, int components) {
  const Cells<const double> fine(from, components);
  const Cells<double> coarse(means, components);
  const std::array<std::ptrdiff_t, 3> stride{fine.stride(0), fine.stride(1), fine.stride(2)};
  Index3 first = box.lower;
  for (int d = 0; d < D; ++d) first[d] *= 2;
  for (int z = 0; z < box.extent(2); ++z) {
    const double* child = fine.at(first) + (D > 2 ? 2 : 1) * z * stride[2];
    double* to = coarse.at(box.lower) + z * coarse.stride(2);
    for (int y = 0; y < box.extent(1); ++y, child += (D > 1 ? 2 : 1) * stride[1], to += coarse.stride(1))
      meansOfRow<D, Components, Count>(child, stride, box.extent(0), components, to);
  }
}

/// Beside a patch rows are short; loops of fixed length take less time there.
template <int D, int Components>
void meansOf(const Box& box, const CellValues& from, const CellValues& means, int components) {
  if (box.empty()) return;
  switch (box.extent(0)) {
    case 1:
      return meansOfRows<D, Components, 1>(box, from, means, components);
    case 2:
      return meansOfRows<D, Components, 2>(box, from, means, components);
    case 3:
      return meansOfRows<D, Components, 3>(box, from, means, components);
    default:
      return meansOfRows<D, Components, 0>(box, from, means, components);
  }
}

template <int D>
void meansOf(const Box& box, const CellValues& from, const CellValues& means, int components) {
  if (components == 1) return meansOf<D, 1>(box, from, means, components);
  components == D ? meansOf<D, D>(box, from, means, components) : meansOf<D, 0>(box, from, means, components);
}

/// Coarse cells, and the finer cells in them.
template <int D, int Components>
class Interpolation {
 public:
  Interpolation(const CellValues& from, const Box& box, const CellValues& to, int components)
      : coarse_(from, components), fine_(to, components), box_(box), components_(components) {}

  /// The slopes of rows of coarse cells are computed in one stretch of memory if these rows are all that is stored, up
  /// to the neighbours; otherwise row by row.
  void run() {
    const Box parents = box_.coarsened(D);
    if (parents.empty()) return;
    const bool isOneStretch = D > 1 && coarse_.stored().extent(0) <= parents.extent(0) + 2;
    Box rows = parents;
    grid::forEach<3>({{{0, parents.lower[1], parents.lower[2]}},
                      {{1, isOneStretch ? parents.lower[1] + 1 : parents.upper[1], parents.upper[2]}}},
                     [&](const Index3& first) {
                       for (int d = 1; d < 3; ++d) rows.lower[d] = first[d], rows.upper[d] = first[d] + 1;
                       if (isOneStretch) rows.upper[1] = parents.upper[1];
                       setSlopes(rows);
                       setChildren(rows);
                     });
  }

 private:
  std::ptrdiff_t numbers() const { return Components > 0 ? Components : components_; }

  /// Computes a quarter of the slopes along each axis in rows of coarse cells of a plane, and in the cells between
  /// these rows, where they mean nothing. A slope is 0 if a neighbour is missing.
  void setSlopes(const Box& rows) {
    first_ = rows.lower;
    toRow_ = coarse_.stride(1);
    const std::ptrdiff_t count = (rows.extent(1) - 1) * toRow_ + rows.extent(0) * numbers();
    room_ = (count + 7) / 8 * 8;
    thread_local std::vector<double> quarters;
    if (quarters.size() < static_cast<std::size_t>(room_) * D) quarters.resize(static_cast<std::size_t>(room_) * D);
    quarters_ = quarters.data();
    const double* middle = coarse_.at(rows.lower);
    for (int d = 0; d < D; ++d) {
      // The first and the last cell of the stretch may have no neighbour that is stored.
      double* quarter = quarters_ + d * room_;
      const std::ptrdiff_t stride = coarse_.stride(d);
      Box lower = rows, upper = rows;
      lower.upper[d] = coarse_.hasBelow(rows.lower[d], d) ? rows.lower[d] : rows.lower[d] + 1;
      upper.lower[d] = coarse_.hasAbove(rows.upper[d] - 1, d) ? rows.upper[d] : rows.upper[d] - 1;
      const std::ptrdiff_t skipped = lower.empty() ? 0 : d == 0 ? numbers() : toRow_;
      const std::ptrdiff_t end = upper.empty() ? count : count - (d == 0 ? numbers() : d == 1 ? toRow_ : count);
      if (d < 2 || (lower.empty() && upper.empty())) {
#pragma GCC ivdep
        for (std::ptrdiff_t k = skipped; k < end; ++k)
          quarter[k] = 0.25 * Mc::slope(middle[k] - middle[k - stride], middle[k + stride] - middle[k]);
      }
      clear(lower, quarter);
      clear(upper, quarter);
    }
  }
  /// Sets the slopes of cells of the stretch to 0.
  void clear(const Box& cells, double* quarter) const {
    grid::forEachRow<3>(
        cells, [&](const Index3& first, int count) { std::fill_n(quarter + offsetOf(first), count * numbers(), 0.0); });
  }
  /// The distance in memory of a coarse cell from the first of the stretch.
  std::ptrdiff_t offsetOf(const Index3& parent) const {
    return (parent[1] - first_[1]) * toRow_ + (parent[0] - first_[0]) * numbers();
  }

  /// Computes the children of rows of coarse cells, as far as they lie in the box.
  void setChildren(const Box& rows) {
    bool areAllInside = true;
    for (int d = 0; d < D; ++d)
      areAllInside = areAllInside && 2 * rows.lower[d] >= box_.lower[d] && 2 * rows.upper[d] <= box_.upper[d];
    grid::forEachRow<3>(rows, [&](const Index3& first, int count) {
      if (areAllInside) return setAllChildren(first, count);
      Index3 parent = first;
      for (; parent[0] < first[0] + count; ++parent[0]) setChildrenInside(parent);
    });
  }
  static Index3 firstChild(Index3 parent) {
    for (int d = 0; d < D; ++d) parent[d] *= 2;
    return parent;
  }
  /// The distance in memory of a child from the lower child along x; each bit of `corner` is its place along one of the
  /// other axes.
  std::ptrdiff_t besideOf(int corner) const {
    std::ptrdiff_t beside = 0;
    for (int d = 1; d < D; ++d) beside += (corner >> (d - 1) & 1) * fine_.stride(d);
    return beside;
  }
  /// Adds the slopes along all axes but x to a value.
  double toCorner(double value, int corner, std::ptrdiff_t at) const {
    for (int d = 1; d < D; ++d) {
      const double quarter = quarters_[d * room_ + at];
      value += (corner >> (d - 1) & 1) != 0 ? quarter : -quarter;
    }
    return value;
  }
  /// All children of a row of cells.
  void setAllChildren(const Index3& first, int count) const {
    const std::ptrdiff_t n = numbers();
    const double *middle = coarse_.at(first), *along = quarters_ + offsetOf(first);
    std::array<double*, 1 << (D - 1)> to{};
    for (int corner = 0; corner < 1 << (D - 1); ++corner)
      to[static_cast<std::size_t>(corner)] = fine_.at(firstChild(first)) + besideOf(corner);
    for (std::ptrdiff_t cell = 0; cell < count; ++cell)
      for (std::ptrdiff_t k = 0; k < n; ++k) {
        const std::ptrdiff_t at = cell * n + k, child = at + cell * n;
        const double below = middle[at] - along[at], above = middle[at] + along[at];
        for (int corner = 0; corner < 1 << (D - 1); ++corner) {
          double* children = to[static_cast<std::size_t>(corner)] + child;
          children[0] = toCorner(below, corner, offsetOf(first) + at);
          children[n] = toCorner(above, corner, offsetOf(first) + at);
        }
      }
  }
  /// Those children of a cell that lie in the box.
  void setChildrenInside(const Index3& parent) const {
    const std::ptrdiff_t n = numbers(), at = offsetOf(parent);
    const double* middle = coarse_.at(parent);
    for (unsigned child = 0; child < 1U << D; ++child) {
      Index3 cell = firstChild(parent);
      for (int d = 0; d < D; ++d) cell[d] += static_cast<int>(child >> d & 1);
      if (!box_.contains(cell)) continue;
      double* to = fine_.at(cell);
      for (std::ptrdiff_t k = 0; k < n; ++k) {
        const double quarter = quarters_[at + k];
        to[k] = toCorner(middle[k] + ((child & 1) != 0 ? quarter : -quarter), static_cast<int>(child >> 1), at + k);
      }
    }
  }

  Cells<const double> coarse_;
  Cells<double> fine_;
  Box box_;
  int components_;
  Index3 first_{};
  std::ptrdiff_t toRow_ = 0;
  double* quarters_ = nullptr;  ///< a quarter of the slopes of a stretch: room_ numbers for each axis
  std::ptrdiff_t room_ = 0;
};

template <int D>
void interpolate(const CellValues& from, const Box& box, const CellValues& to, int components) {
  if (components == 1) return Interpolation<D, 1>(from, box, to, components).run();
  components == D ? Interpolation<D, D>(from, box, to, components).run()
                  : Interpolation<D, 0>(from, box, to, components).run();
}

void copyFirstChildren(const Label& label, int dimension, const Box& box, const CellValues& fine,
                       const CellValues& coarse) {
  grid::forEach<3>(box, [&](const Index3& cell) {
    Index3 child = cell;
    for (int d = 0; d < dimension; ++d) child[d] *= 2;
    std::memcpy(coarse.values + coarse.stored.offset(cell) * label.bytes,
                fine.values + fine.stored.offset(child) * label.bytes, label.bytes);
  });
}

void copyParents(const Label& label, int dimension, const CellValues& coarse, const Box& box, const CellValues& fine) {
  grid::forEach<3>(box, [&](const Index3& cell) {
    Index3 of = cell;
    for (int d = 0; d < dimension; ++d) of[d] = grid::coarserCell(cell[d]);
    std::memcpy(fine.values + fine.stored.offset(cell) * label.bytes,
                coarse.values + coarse.stored.offset(of) * label.bytes, label.bytes);
  });
}

}  // namespace

void restrictTo(const Label& label, int dimension, const Box& box, const CellValues& fine, const CellValues& coarse) {
  if (label.number != data::Number::real) return copyFirstChildren(label, dimension, box, fine, coarse);
  if (dimension == 1) return meansOf<1>(box, fine, coarse, label.components);
  dimension == 2 ? meansOf<2>(box, fine, coarse, label.components) : meansOf<3>(box, fine, coarse, label.components);
}

void prolong(const Label& label, int dimension, const CellValues& coarse, const Box& box, const CellValues& fine) {
  if (label.number != data::Number::real) return copyParents(label, dimension, coarse, box, fine);
  if (dimension == 1) return interpolate<1>(coarse, box, fine, label.components);
  dimension == 2 ? interpolate<2>(coarse, box, fine, label.components)
                 : interpolate<3>(coarse, box, fine, label.components);
}

const std::vector<CellValues>& prolongTogether(const data::VariableTable::Joint& joint, int dimension,
                                               const std::vector<CellValues>& coarse, const Box& box) {
  const Box parents = box.coarsened(dimension), whole = parents.refined(dimension);
  thread_local std::vector<std::byte> memory;
  thread_local std::vector<CellValues> fine;
  std::size_t bytes = 0;
  for (const Label* label : joint.labels) bytes += whole.size() * label->bytes;
  if (memory.size() < bytes) memory.resize(bytes);
  fine.clear();
  std::byte* next = memory.data();
  for (std::size_t k = 0; k < joint.labels.size(); ++k) {
    fine.push_back({next, whole});
    prolong(*joint.labels[k], dimension, coarse[k], whole, fine[k]);
    next += whole.size() * joint.labels[k]->bytes;
  }
  joint.how->correct(parents, coarse, fine);
  return fine;
}

}  // namespace tushar::tasks
