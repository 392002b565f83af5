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
  bool hasBoth(const Index3& cell, int axis) const {
    return cell[axis] > stored_.lower[axis] && cell[axis] + 1 < stored_.upper[axis];
  }

 private:
  Number* numbers_;
  Box stored_;
  std::ptrdiff_t components_;
  std::array<std::ptrdiff_t, 3> stride_{};
};

/// The means of a row of `count` cells, from their first child. `Components`: 0 if it is not known at compile time.
template <int D, int Components>
void meansOfRow(const double* child, const std::array<std::ptrdiff_t, 3>& stride, int count, int components,
                double* to) {
  const std::ptrdiff_t x = stride[0], y = stride[1], z = stride[2];
  const int numbers = Components > 0 ? Components : components;
  for (int cell = 0; cell < count; ++cell, child += x)  // the second one along x
    for (int k = 0; k < numbers; ++k, ++child) {
      const auto pair = [&](std::ptrdiff_t beside) { return child[beside] + child[beside + x]; };
      if constexpr (D == 1) *to++ = 0.5 * pair(0);
      if constexpr (D == 2) *to++ = 0.25 * (pair(0) + pair(y));
      if constexpr (D == 3) *to++ = 0.125 * ((pair(0) + pair(y)) + (pair(z) + pair(y + z)));
    }
}

template <int D, int Components>
void meansOf(const Box& box, const CellValues& from, const CellValues& means, int components) {
  if (box.empty()) return;
  const Cells<const double> fine(from, components);
  const Cells<double> coarse(means, components);
  const std::array<std::ptrdiff_t, 3> stride{fine.stride(0), fine.stride(1), fine.stride(2)};
  Index3 first = box.lower;
  for (int d = 0; d < D; ++d) first[d] *= 2;
  for (int z = 0; z < box.extent(2); ++z) {
    const double* child = fine.at(first) + (D > 2 ? 2 : 1) * z * stride[2];
    double* to = coarse.at(box.lower) + z * coarse.stride(2);
    for (int y = 0; y < box.extent(1); ++y, child += (D > 1 ? 2 : 1) * stride[1], to += coarse.stride(1))
      meansOfRow<D, Components>(child, stride, box.extent(0), components, to);
  }
}

template <int D>
void meansOf(const Box& box, const CellValues& from, const CellValues& means, int components) {
  if (components == 1) return meansOf<D, 1>(box, from, means, components);
  components == D ? meansOf<D, D>(box, from, means, components) : meansOf<D, 0>(box, from, means, components);
}

/// The children of a coarse cell that lie in a box; one bit per axis identifies a child.
template <int D>
unsigned childrenIn(const Box& box, const Index3& first) {
  unsigned inside = 0;
  for (unsigned child = 0; child < 1u << D; ++child) {
    bool isInside = true;
    for (int d = 0; d < D; ++d) {
      const int at = first[d] + static_cast<int>(child >> d & 1);
      isInside = isInside && at >= box.lower[d] && at < box.upper[d];
    }
    inside |= static_cast<unsigned>(isInside) << child;
  }
  return inside;
}

/// A coarse cell, and the finer cells in it.
template <int D>
struct Family {
  const double* parent;
  std::array<std::ptrdiff_t, D> stride;  ///< distance to the parent's neighbours; 0: one is missing
  double* first;                         ///< values of the first child
  unsigned inside;                       ///< children to be computed, one bit each
};

/// Interpolates the children of a coarse cell. `beside`: the distance in memory of each child from the first.
/// `Components`: 0 if it is not known at compile time.
template <int D, int Components, bool AllInside>
void interpolate(Family<D> family, const std::array<std::ptrdiff_t, 1 << D>& beside, int numbers) {
  const int components = Components > 0 ? Components : numbers;
  const auto& stride = family.stride;
  for (int k = 0; k < components; ++k, ++family.parent, ++family.first) {
    const double* middle = family.parent;
    std::array<double, D> quarter{};
    for (std::size_t d = 0; d < D; ++d)
      quarter[d] = 0.25 * Mc::slope(*middle - middle[-stride[d]], middle[stride[d]] - *middle);
    for (unsigned child = 0; child < beside.size(); ++child) {
      if (!AllInside && !(family.inside >> child & 1)) continue;
      double value = *middle;
      for (unsigned d = 0; d < D; ++d) value += child >> d & 1 ? quarter[d] : -quarter[d];
      family.first[beside[child]] = value;
    }
  }
}

/// Computes a quarter of the slope of each number, whose neighbours are `stride` places before and after it; `stride`
/// is 0 if a neighbour is missing.
void quarterSlopes(const double* middle, std::ptrdiff_t stride, std::ptrdiff_t count, double* quarter) {
  if (stride == 0) return static_cast<void>(std::fill_n(quarter, count, 0.0));
#pragma GCC ivdep
  for (std::ptrdiff_t k = 0; k < count; ++k)
    quarter[k] = 0.25 * Mc::slope(middle[k] - middle[k - stride], middle[k + stride] - middle[k]);
}

/// Coarse cells, and the finer cells in them.
template <int D, int Components>
class Interpolation {
 public:
  Interpolation(const CellValues& from, const Box& box, const CellValues& to, int components)
      : coarse_(from, components), fine_(to, components), box_(box), components_(components) {
    for (unsigned child = 0; child < beside_.size(); ++child)
      for (int d = 0; d < D; ++d) beside_[child] += (child >> d & 1) * fine_.stride(d);
  }

  void run() {
    constexpr int fewest = 4;  // cells of a row that pay off
    grid::forEachRow<3>(box_.coarsened(D), [&](const Index3& first, int count) {
      Index3 last = first;
      last[0] += count - 1;
      const bool areAllInside = insideOf(first) == all && insideOf(last) == all;
      if (areAllInside && count >= fewest) return ofRow(first, last);
      for (Index3 parent = first; parent[0] <= last[0]; ++parent[0])
        ofCell(parent, areAllInside ? all : insideOf(parent));
    });
  }

 private:
  static constexpr unsigned all = (1U << (1 << D)) - 1;

  std::ptrdiff_t strideOf(const Index3& parent, int axis) const {
    return coarse_.hasBoth(parent, axis) ? coarse_.stride(axis) : 0;
  }
  static Index3 firstChild(Index3 parent) {
    for (int d = 0; d < D; ++d) parent[d] *= 2;
    return parent;
  }
  unsigned insideOf(const Index3& parent) const { return childrenIn<D>(box_, firstChild(parent)); }

  void ofCell(const Index3& parent, unsigned inside) {
    Family<D> family{coarse_.at(parent), {}, fine_.at(firstChild(parent)), inside};
    for (int d = 0; d < D; ++d) family.stride[static_cast<std::size_t>(d)] = strideOf(parent, d);
    inside == all ? interpolate<D, Components, true>(family, beside_, components_)
                  : interpolate<D, Components, false>(family, beside_, components_);
  }

  /// All children of a row of cells; bitwise equal to the children of single cells.
  void ofRow(const Index3& first, const Index3& last) {
    const std::ptrdiff_t cell = Components > 0 ? Components : components_, count = (last[0] - first[0] + 1) * cell;
    thread_local std::vector<double> quarters;
    if (quarters.size() < static_cast<std::size_t>(count) * D) quarters.resize(static_cast<std::size_t>(count) * D);
    const double* middle = coarse_.at(first);
    std::array<const double*, D> quarter{};
    for (int d = 0; d < D; ++d) {
      double* slopes = quarters.data() + d * count;
      quarter[static_cast<std::size_t>(d)] = slopes;
      if (d > 0) {
        quarterSlopes(middle, strideOf(first, d), count, slopes);
        continue;
      }
      quarterSlopes(middle, strideOf(first, 0), cell, slopes);
      quarterSlopes(middle + cell, cell, count - 2 * cell, slopes + cell);
      quarterSlopes(middle + count - cell, strideOf(last, 0), cell, slopes + count - cell);
    }
    for (unsigned child = 0; child < beside_.size(); ++child) {
      double* to = fine_.at(firstChild(first)) + beside_[child];
      for (std::ptrdiff_t at = 0; at < count; to += cell)
        for (const std::ptrdiff_t end = at + cell; at < end; ++at) {
          double value = middle[at];
          for (unsigned d = 0; d < D; ++d) value += child >> d & 1 ? quarter[d][at] : -quarter[d][at];
          *to++ = value;
        }
    }
  }

  Cells<const double> coarse_;
  Cells<double> fine_;
  Box box_;
  int components_;
  std::array<std::ptrdiff_t, 1 << D> beside_{};  ///< the distance in memory of each child from the first
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

}  // namespace tushar::tasks
