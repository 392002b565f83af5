#include "core/tasks/transfer.hpp"

#include <array>
#include <cstring>

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

template <int D>
void meansOf(const Box& box, const CellValues& from, const CellValues& means, int components) {
  const Cells<const double> fine(from, components);
  const Cells<double> coarse(means, components);
  const std::ptrdiff_t x = fine.stride(0), y = fine.stride(1), z = fine.stride(2);
  grid::forEachRow<3>(box, [&](Index3 first, int count) {
    double* to = coarse.at(first);
    for (int d = 0; d < D; ++d) first[d] *= 2;
    const double* child = fine.at(first);
    for (int cell = 0; cell < count; ++cell, child += x)  // the second one along x
      for (int k = 0; k < components; ++k, ++child) {
        const auto pair = [&](std::ptrdiff_t beside) { return child[beside] + child[beside + x]; };
        if constexpr (D == 1) *to++ = 0.5 * pair(0);
        if constexpr (D == 2) *to++ = 0.25 * (pair(0) + pair(y));
        if constexpr (D == 3) *to++ = 0.125 * ((pair(0) + pair(y)) + (pair(z) + pair(y + z)));
      }
  });
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

template <int D>
void interpolate(const CellValues& from, const Box& box, const CellValues& to, int components) {
  const Cells<const double> coarse(from, components);
  const Cells<double> fine(to, components);
  std::array<std::ptrdiff_t, 1 << D> beside{};  // of each child, from the first
  for (unsigned child = 0; child < beside.size(); ++child)
    for (int d = 0; d < D; ++d) beside[child] += (child >> d & 1) * fine.stride(d);
  grid::forEach<3>(box.coarsened(D), [&](const Index3& parent) {
    Index3 first = parent;
    std::array<std::ptrdiff_t, D> stride{};
    for (int d = 0; d < D; ++d) {
      first[d] *= 2;
      stride[static_cast<std::size_t>(d)] = coarse.hasBoth(parent, d) ? coarse.stride(d) : 0;
    }
    const unsigned inside = childrenIn<D>(box, first);
    const double* middle = coarse.at(parent);
    double* child0 = fine.at(first);
    for (int k = 0; k < components; ++k, ++middle, ++child0) {
      std::array<double, D> quarter{};
      for (std::size_t d = 0; d < D; ++d)
        quarter[d] = 0.25 * Mc::slope(*middle - middle[-stride[d]], middle[stride[d]] - *middle);
      for (unsigned child = 0; child < beside.size(); ++child) {
        if (!(inside >> child & 1)) continue;
        double value = *middle;
        for (unsigned d = 0; d < D; ++d) value += child >> d & 1 ? quarter[d] : -quarter[d];
        child0[beside[child]] = value;
      }
    }
  });
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
