#pragma once

#include <array>
#include <cstddef>

namespace tushar::mpm::solid {

// Shape functions along an axis, in units of the cell width: `xi` in [0,1] is where the particle stands in its cell,
// `size` its extent. Each fills the values and derivatives at consecutive nodes and returns the first node's number,
// where 0 is the lower node of the cell. A Real is a number, or a Quad of one for each axis, for all axes at once.

/// Piecewise linear ("tent") functions.
struct LinearAxis {
  static constexpr int nodes = 2;
  static constexpr int ghostNodes = 0;  ///< nodes beyond those of the cell that a particle touches
  static constexpr bool hasSize = false;

  template <class Real>
  [[gnu::always_inline]] static Real fill(const Real& xi, const Real&, std::array<Real, nodes>& s,
                                          std::array<Real, nodes>& ds) {
    const Real zero{};
    s = {1 - xi, xi};
    ds = {zero - 1, zero + 1};
    return zero;
  }
};

/// Generalised interpolation: the mean of the linear function over the particle's extent, which stays as at the start;
/// Bardenhagen & Kober, CMES 5 (2004) 477, with the piecewise form of uniform GIMP.
struct GimpAxis {
  static constexpr int nodes = 3;
  static constexpr int ghostNodes = 1;
  static constexpr bool hasSize = true;

  template <class Real>
  [[gnu::always_inline]] static Real fill(const Real& xi, const Real& size, std::array<Real, nodes>& s,
                                          std::array<Real, nodes>& ds) {
    const Real zero{}, first = xi < 0.5 ? zero - 1 : zero;
    const Real inverse = 1 / size, lower = xi - first - 0.5 * size, upper = lower + size;
    for (std::size_t k = 0; k < nodes; ++k) {
      const Real a = lower - static_cast<double>(k), b = upper - static_cast<double>(k);
      const Real fromBelow = within(-b), toBelow = within(-a), fromAbove = within(a), toAbove = within(b);
      const Real below = toBelow - fromBelow, above = toAbove - fromAbove;
      s[k] = inverse * 0.5 * (below * ((1 - fromBelow) + (1 - toBelow)) + above * ((1 - fromAbove) + (1 - toAbove)));
      ds[k] = inverse * (below - above);
    }
    return first;
  }

 private:
  // The means are over what lies within [0,1] on either side of the node, of the tent function 1 - r. Nothing here has
  // branches or takes large numbers from each other: where a particle barely touches a node, S and its slope are small,
  // and the force over the mass that they make is only right if both are right to the last digits.

  template <class Real>
  [[gnu::always_inline]] static Real within(const Real& r) {
    const Real zero{}, one = zero + 1, positive = r > zero ? r : zero;
    return positive < one ? positive : one;
  }
};

/// Quadratic B-splines about the nodes; Steffen, Kirby & Berzins, Int. J. Numer. Meth. Engng 76 (2008) 922.
struct QuadraticAxis {
  static constexpr int nodes = 3;
  static constexpr int ghostNodes = 1;
  static constexpr bool hasSize = false;

  template <class Real>
  [[gnu::always_inline]] static Real fill(const Real& xi, const Real&, std::array<Real, nodes>& s,
                                          std::array<Real, nodes>& ds) {
    const Real zero{}, first = xi < 0.5 ? zero - 1 : zero;
    const Real r = xi - (first + 1), below = 0.5 - r, above = 0.5 + r;
    s = {0.5 * below * below, 0.75 - r * r, 0.5 * above * above};
    ds = {-below, -2 * r, above};
    return first;
  }
};

/// Cubic B-splines about the nodes; same source.
struct CubicAxis {
  static constexpr int nodes = 4;
  static constexpr int ghostNodes = 1;
  static constexpr bool hasSize = false;

  template <class Real>
  [[gnu::always_inline]] static Real fill(const Real& xi, const Real&, std::array<Real, nodes>& s,
                                          std::array<Real, nodes>& ds) {
    const Real zero{}, eta = 1 - xi;
    s = {eta * eta * eta / 6, 2.0 / 3 - xi * xi + xi * xi * xi / 2, 2.0 / 3 - eta * eta + eta * eta * eta / 2,
         xi * xi * xi / 6};
    ds = {-eta * eta / 2, -2 * xi + 1.5 * xi * xi, 2 * eta - 1.5 * eta * eta, xi * xi / 2};
    return zero - 1;
  }
};

}  // namespace tushar::mpm::solid
