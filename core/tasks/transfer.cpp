#include "core/tasks/transfer.hpp"

#include <array>
#include <cstring>

#include "core/base/limiters.hpp"

namespace tushar::tasks {

using data::Label;
using grid::Box;

namespace {

/// Values of cells in memory, and the distances between those of neighbours.
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
void meansOf(const Box& box, const CellValues& values, int components, double* to) {
  const Cells<const double> fine(values, components);
  const std::ptrdiff_t x = fine.stride(0), y = fine.stride(1), z = fine.stride(2);
  grid::forEachRow<3>(box, [&](Index3 first, int count) {
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

/// A finer cell: its values, and its side of its parent's centre along each axis, -1 or 1.
struct Child {
  double* numbers;
  std::array<double, 3> side;
};

/// The children of a coarse cell that are in a box.
template <int D>
class Children {
 public:
  Children(const Cells<double>& fine, const Box& box, const Index3& parent) {
    const Box all = Box{parent, parent + Index3::filled(1)}.refined(D);
    grid::forEach<3>(all.intersect(box), [&](const Index3& cell) {
      Child& child = children_[count_++];
      child.numbers = fine.at(cell);
      for (int d = 0; d < D; ++d) child.side[static_cast<std::size_t>(d)] = cell[d] == all.lower[d] ? -1 : 1;
    });
  }
  const Child* begin() const { return children_.data(); }
  const Child* end() const { return begin() + count_; }

 private:
  std::array<Child, 1 << D> children_;
  std::size_t count_ = 0;
};

template <int D>
void interpolate(const CellValues& from, const Box& box, const CellValues& to, int components) {
  const Cells<const double> coarse(from, components);
  const Cells<double> fine(to, components);
  grid::forEach<3>(box.coarsened(D), [&](const Index3& parent) {
    const Children<D> children(fine, box, parent);
    std::array<std::ptrdiff_t, D> stride{};
    for (int d = 0; d < D; ++d) stride[static_cast<std::size_t>(d)] = coarse.hasBoth(parent, d) ? coarse.stride(d) : 0;
    const double* middle = coarse.at(parent);
    for (int k = 0; k < components; ++k, ++middle) {
      std::array<double, D> quarter{};
      for (std::size_t d = 0; d < D; ++d)
        quarter[d] = 0.25 * Mc::slope(*middle - middle[-stride[d]], middle[stride[d]] - *middle);
      for (const Child& child : children) {
        double value = *middle;
        for (std::size_t d = 0; d < D; ++d) value += child.side[d] * quarter[d];
        child.numbers[k] = value;
      }
    }
  });
}

void copyFirstChildren(const Label& label, int dimension, const Box& box, const CellValues& fine, std::byte* to) {
  grid::forEach<3>(box, [&](const Index3& cell) {
    Index3 child = cell;
    for (int d = 0; d < dimension; ++d) child[d] *= 2;
    std::memcpy(to, fine.values + fine.stored.offset(child) * label.bytes, label.bytes);
    to += label.bytes;
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

void restrictTo(const Label& label, int dimension, const Box& box, const CellValues& fine, std::byte* to) {
  if (label.number != data::Number::real) return copyFirstChildren(label, dimension, box, fine, to);
  auto* means = reinterpret_cast<double*>(to);
  if (dimension == 1) return meansOf<1>(box, fine, label.components, means);
  dimension == 2 ? meansOf<2>(box, fine, label.components, means) : meansOf<3>(box, fine, label.components, means);
}

void prolong(const Label& label, int dimension, const CellValues& coarse, const Box& box, const CellValues& fine) {
  if (label.number != data::Number::real) return copyParents(label, dimension, coarse, box, fine);
  if (dimension == 1) return interpolate<1>(coarse, box, fine, label.components);
  dimension == 2 ? interpolate<2>(coarse, box, fine, label.components)
                 : interpolate<3>(coarse, box, fine, label.components);
}

}  // namespace tushar::tasks
