#include "core/tasks/transfer.hpp"

#include <cstring>

#include "core/base/limiters.hpp"

namespace tushar::tasks {

using data::Label;
using grid::Box;

namespace {

const double* numbers(const CellValues& values, const Index3& cell, int components) {
  return reinterpret_cast<const double*>(values.values) +
         values.stored.offset(cell) * static_cast<std::size_t>(components);
}

/// The change of one number over a coarse cell along an axis.
double slopeOf(const CellValues& coarse, const Index3& cell, int axis, int components, int component) {
  Index3 below = cell, above = cell;
  --below[axis];
  ++above[axis];
  if (below[axis] < coarse.stored.lower[axis] || above[axis] >= coarse.stored.upper[axis]) return 0;
  const double middle = numbers(coarse, cell, components)[component];
  return Mc::slope(middle - numbers(coarse, below, components)[component],
                   numbers(coarse, above, components)[component] - middle);
}

template <int D>
void meansOf(const Box& box, const CellValues& fine, int components, double* to) {
  grid::forEach<3>(box, [&](const Index3& cell) {
    const auto child = [&](int x, int y, int z) {
      return numbers(fine, {{2 * cell[0] + x, D > 1 ? 2 * cell[1] + y : cell[1], D > 2 ? 2 * cell[2] + z : cell[2]}},
                     components);
    };
    for (int k = 0; k < components; ++k) {
      const auto along = [&](int y, int z) { return child(0, y, z)[k] + child(1, y, z)[k]; };
      if constexpr (D == 1) *to++ = 0.5 * along(0, 0);
      if constexpr (D == 2) *to++ = 0.25 * (along(0, 0) + along(1, 0));
      if constexpr (D == 3) *to++ = 0.125 * ((along(0, 0) + along(1, 0)) + (along(0, 1) + along(1, 1)));
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
  const int components = label.components;
  grid::forEach<3>(box, [&](const Index3& cell) {
    Index3 of = cell;
    for (int d = 0; d < dimension; ++d) of[d] = grid::coarserCell(cell[d]);
    auto* to = reinterpret_cast<double*>(fine.values + fine.stored.offset(cell) * label.bytes);
    for (int k = 0; k < components; ++k) {
      double value = numbers(coarse, of, components)[k];
      for (int d = 0; d < dimension; ++d) {
        const double change = 0.25 * slopeOf(coarse, of, d, components, k);
        value = cell[d] == 2 * of[d] ? value - change : value + change;
      }
      to[k] = value;
    }
  });
}

}  // namespace tushar::tasks
