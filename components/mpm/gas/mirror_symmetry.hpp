#pragma once

#include "components/mpm/shapes/linear.hpp"

// Bitwise mirror symmetry: the result of a mirrored scene is the exact mirror image of the original result.
// Floating-point sums depend on their order, so sums over particles and nodes treat both sides in the same way.
// Positions are measured from the middle of a cell or of the grid, because distances from a lower corner round
// differently in the mirror image.

namespace tushar::mpm::gas {

/// The centre of the grid along a kernel axis [m].
inline double middleOf(const Level& level, int kernelAxis) {
  const auto& domain = level.domain();
  const int axis = level.axis(kernelAxis);
  const double lower = domain.lower[axis], upper = domain.upper[axis];
  return upper > lower ? 0.5 * (lower + upper)
                       : lower + 0.5 * level.cells().upper[kernelAxis] * level.spacing(kernelAxis);
}

/// The signed distance of a cell's centre from the middle of the grid, in cells. For the mirror image of the cell, it
/// has exactly the opposite value.
template <class Number>
Number fromMiddle(const Level& level, int kernelAxis, const Number& cell) {
  return cell - 0.5 * (level.cells().upper[kernelAxis] - 1);
}

/// The position `offset` cells from the centre of a cell along a kernel axis [m], computed from the middle of the grid.
inline double positionInCell(const Level& level, int kernelAxis, int cell, double offset) {
  const double cells = fromMiddle<double>(level, kernelAxis, cell) + offset;
  return middleOf(level, kernelAxis) + cells * level.spacing(kernelAxis);
}

/// The gradient of the shape function of node k at the centre of a cell, 1/m.
template <int D>
Vec<D> centreGradient(const Level& level, int k) {
  Vec<D> gradient;
  for (int d = 0; d < D; ++d) gradient[d] = Linear<D>::centreGradient(level, k, d);
  return gradient;
}

/// Sum of `term(k)` over the nodes k of a cell, or over the cells k around a node. Neighbours along the first axis are
/// added first, then those along the next, so that a mirror image only exchanges the two terms of an addition.
template <int D, class Term>
[[gnu::always_inline]] inline auto sumOverCorners(Term&& term, int k = 0) {
  if constexpr (D == 0) {
    return term(k);
  } else {
    auto sum = sumOverCorners<D - 1>(term, k);
    sum += sumOverCorners<D - 1>(term, k + (1 << (D - 1)));
    return sum;
  }
}

/// Sum over the particles p of a cell; `add(p, sum)` adds the term of p. The terms are added from both ends of the
/// cell's list inwards, each half separately: in the mirror image of a line the list is reversed, which only exchanges
/// the halves.
template <class Sum, class Add>
[[gnu::always_inline]] inline Sum sumOverParticles(const data::ParticleRange& particles, Add&& add) {
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
