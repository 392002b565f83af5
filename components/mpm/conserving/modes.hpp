#pragma once

#include "core/core.hpp"

namespace tushar::mpm {

/// The velocity within a box, u(x) = sum over a of u_a phi_a(x), phi_a the product of (x_d - centre_d) over the axes of
/// a: bit d of a says whether axis d is among them. Column a - 1 holds u_a; u_0, the mean, is kept apart (p.velocity).
/// Columns 0, 1, 3 are the velocity gradient [1/s]; those of several axes are the mixed modes [1/(m s), 1/(m² s)].
template <int D>
using Modes = Eigen::Matrix<double, D, (1 << D) - 1, Eigen::DontAlign>;

/// A square matrix over the axes.
template <int D>
using Tensor = Eigen::Matrix<double, D, D, Eigen::DontAlign>;

/// The column of the derivative along an axis.
constexpr int gradientColumn(int axis) { return (1 << axis) - 1; }

/// Product of one value per axis over the axes of `a`.
template <class Values>
double productOver(int a, const Values& values) {
  double product = 1;
  for (int d = 0; (a >> d) != 0; ++d)
    if ((a >> d) & 1) product *= values[d];
  return product;
}

/// Kinetic energy per mass of the motion about the mean, K = 1/2 sum of I_a |u_a|², I_a the product of `inertia`
/// over the axes of a: mean squares of x_d - centre_d [m²] over whatever the modes are orthogonal on.
template <int D>
double modalEnergy(const Modes<D>& modes, const Vec<D>& inertia) {
  double energy = 0;
  for (int a = 1; a < (1 << D); ++a) energy += 0.5 * productOver(a, inertia) * modes.col(a - 1).squaredNorm();
  return energy;
}

}  // namespace tushar::mpm
