#pragma once

#include "core/core.hpp"

namespace tushar::mpm::gas::conserving {

/// The velocity within a box, u(x) = sum over a of u_a phi_a(x), where phi_a is the product of (x_d - centre_d) over
/// the axes of a: axis d is among them if bit d of a is set. Column a - 1 contains u_a; u_0, the mean, is p.velocity.
/// Columns 0, 1, 3 are the velocity gradient [1/s]; the others are the mixed modes [1/(m s), 1/(m² s)].
template <int D>
using Modes = Eigen::Matrix<double, D, (1 << D) - 1, Eigen::DontAlign>;

/// A square matrix over the axes.
template <int D>
using Tensor = Eigen::Matrix<double, D, D, Eigen::DontAlign>;

/// The column of the derivative along an axis.
constexpr int gradientColumn(int axis) { return (1 << axis) - 1; }

/// For each set of axes a, the product of `values` over the axes in a; the first product is empty, hence 1.
template <class Values>
auto productsOver(const Values& values) {
  constexpr std::size_t dimension = Values::SizeAtCompileTime;
  std::array<typename Values::Scalar, std::size_t{1} << dimension> products;
  products[0] = 1;
  for (std::size_t d = 0; d < dimension; ++d)
    for (std::size_t a = 0; a < std::size_t{1} << d; ++a)
      products[a + (std::size_t{1} << d)] = products[a] * values[static_cast<int>(d)];
  return products;
}

/// Kinetic energy per mass of the motion about the mean, K = 1/2 sum of I_a |u_a|², where I_a is the product of
/// `inertia` over the axes of a. `inertia` contains the mean squares of x_d - centre_d [m²] over the box, or over the
/// nodes that represent it.
template <int D, class Real>
Real modalEnergy(const Eigen::Matrix<Real, D, (1 << D) - 1, Eigen::DontAlign>& modes,
                 const Eigen::Matrix<Real, D, 1, Eigen::DontAlign>& inertia) {
  const auto products = productsOver(inertia);
  Real energy = 0;
  for (std::size_t a = 1; a < products.size(); ++a) {
    const auto u = modes.col(static_cast<int>(a) - 1);
    Real square = u[0] * u[0];  // Eigen adds up those of numbers and those of lanes in different orders
    for (int d = 1; d < D; ++d) square += u[d] * u[d];
    energy += 0.5 * products[a] * square;
  }
  return energy;
}

}  // namespace tushar::mpm::gas::conserving
