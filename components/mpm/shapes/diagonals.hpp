#pragma once

#include <Eigen/Core>

#include "core/base/vec.hpp"

namespace tushar::mpm {

/// Shortens those half diagonals of a parallelepiped that `length` measures as longer than `longest`, keeping their
/// direction, and computes its half edges from them, as in Homel, Brannon & Guilkey, Int. J. Numer. Meth. Engng 107
/// (2016) 31. In three dimensions the edges fit four diagonals only in the mean. Leaves `halfEdges` as they are if no
/// diagonal is too long.
template <int D, class Length>
void shortenDiagonals(Eigen::Matrix<double, D, D>& halfEdges, double longest, const Length& length) {
  constexpr int diagonals = 1 << (D - 1);
  const auto sign = [](int diagonal, int edge) { return edge < D - 1 && ((diagonal >> edge) & 1) ? -1.0 : 1.0; };
  Eigen::Matrix<double, D, D> shortened = Eigen::Matrix<double, D, D>::Zero();
  bool isShorter = false;
  for (int k = 0; k < diagonals; ++k) {
    Vec<D> diagonal = Vec<D>::Zero();
    for (int j = 0; j < D; ++j) diagonal += sign(k, j) * halfEdges.col(j);
    const double own = length(diagonal);
    if (own > longest) diagonal *= longest / own;
    isShorter = isShorter || own > longest;
    for (int j = 0; j < D; ++j) shortened.col(j) += sign(k, j) / diagonals * diagonal;
  }
  if (isShorter) halfEdges = shortened;
}

/// How far a parallelepiped with the given half edges extends from its centre, along the axis where this is farthest.
template <int D>
double extentFromCentre(const Eigen::Matrix<double, D, D>& halfEdges) {
  return halfEdges.cwiseAbs().rowwise().sum().maxCoeff();
}

/// Shrinks a parallelepiped, given in cells, that extends farther than one cell from its centre, until it extends one
/// cell. Each of its diagonals is shortened by itself: a domain that is stretched and sheared until its edges are
/// nearly parallel becomes shorter but not thinner, so that gradients from its corners remain accurate.
template <int D>
void shrinkToCell(Eigen::Matrix<double, D, D>& halfEdges) {
  shortenDiagonals<D>(halfEdges, 1.0, [](const Vec<D>& diagonal) { return diagonal.cwiseAbs().maxCoeff(); });
  const double rest = extentFromCentre<D>(halfEdges);
  if (rest > 1) halfEdges /= rest;
}

}  // namespace tushar::mpm
