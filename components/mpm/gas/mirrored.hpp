#pragma once

#include "components/mpm/shapes/linear.hpp"

// What the gas methods compute so that the mirror image of a scene has the mirrored bits.

namespace tushar::mpm::gas {

/// The middle of the grid along a kernel axis, m.
inline double middleOf(const Level& level, int kernelAxis) {
  const auto& domain = level.domain();
  const int axis = level.axis(kernelAxis);
  const double lower = domain.lower[axis], upper = domain.upper[axis];
  return upper > lower ? 0.5 * (lower + upper)
                       : lower + 0.5 * level.cells().upper[kernelAxis] * level.spacing(kernelAxis);
}

/// How many cells the middle of a cell lies from the middle of the grid; opposite for the mirror image of the cell.
template <class Number>
Number fromMiddle(const Level& level, int kernelAxis, const Number& cell) {
  return cell - 0.5 * (level.cells().upper[kernelAxis] - 1);
}

/// The position that is `offset` cells from the middle of a cell along a kernel axis, m: counted from the middle of the
/// grid.
inline double positionInCell(const Level& level, int kernelAxis, int cell, double offset) {
  const double cells = fromMiddle<double>(level, kernelAxis, cell) + offset;
  return middleOf(level, kernelAxis) + cells * level.spacing(kernelAxis);
}

/// Where a cell lies, so that its particles find what its nodes have for them.
template <int D>
class CellMiddle {
 public:
  CellMiddle(const Level& level, const Index<D>& cell) {
    for (int d = 0; d < D; ++d) {
      middle_[d] = positionInCell(level, d, cell[d], 0);
      inverseSpacing_[d] = level.inverseSpacing(d);
    }
  }
  /// S_k(x) for each node of the cell, numbered as in Linear.
  std::array<double, Linear<D>::nodes> weights(const Vec<D>& x) const {
    const Vec<D> xi = (x - middle_).cwiseProduct(inverseSpacing_);
    std::array<double, Linear<D>::nodes> w{1.0};
    for (int d = 0; d < D; ++d)
      for (int k = 0; k < 1 << d; ++k) {
        const auto low = static_cast<std::size_t>(k), high = static_cast<std::size_t>(k + (1 << d));
        w[high] = w[low] * (0.5 + xi[d]);
        w[low] *= 0.5 - xi[d];
      }
    return w;
  }

 private:
  Vec<D> middle_;          ///< m
  Vec<D> inverseSpacing_;  ///< 1/m
};

/// grad S_k in the middle of a cell, 1/m.
template <int D>
Vec<D> centreGradient(const Level& level, int k) {
  Vec<D> gradient;
  for (int d = 0; d < D; ++d) gradient[d] = Linear<D>::centreGradient(level, k, d);
  return gradient;
}

/// Sum of `term(k)` over the nodes k of a cell, or the cells around a node: neighbours along the first axis with each
/// other, then along the next.
template <int D, class Term>
auto sumOverCorners(Term&& term, int k = 0) {
  if constexpr (D == 0) {
    return term(k);
  } else {
    auto sum = sumOverCorners<D - 1>(term, k);
    sum += sumOverCorners<D - 1>(term, k + (1 << (D - 1)));
    return sum;
  }
}

/// Sum of what `add(p, sum)` adds for the particles of a cell: from both ends of their order inwards, each half by
/// itself; on a line the mirror image has them in reverse order.
template <class Sum, class Add>
Sum sumFromBothEnds(const data::ParticleRange& particles, Add&& add) {
  Sum front{}, back{};
  int first = particles.first, last = particles.last - 1;
  for (; first < last; ++first, --last) {
    add(first, front);
    add(last, back);
  }
  front += back;
  if (first == last) add(first, front);
  return front;
}

}  // namespace tushar::mpm::gas
