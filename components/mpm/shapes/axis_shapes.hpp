#pragma once

#include <array>
#include <cstddef>

namespace tushar::mpm {

// Shape functions along an axis, in units of the cell width: `xi` in [0,1] is the position of the particle in its cell,
// `size` its extent. Each fills the values and derivatives at consecutive nodes and returns the first node's number,
// where 0 is the lower node of the cell. A Real is a number for one axis, or a Quad with one number for each axis. No
// particle touches a node that is `support` cells away or more.

/// Piecewise linear shape functions ("tent" functions).
struct LinearAxis {
  static constexpr int nodes = 2;
  /// Number of layers of nodes, beyond the nodes of its own cell, to which a particle contributes.
  static constexpr int ghostNodes = 0;
  static constexpr bool hasSize = false;
  static double support(double) { return 1; }

  template <class Real>
  [[gnu::always_inline]] static Real fill(const Real& xi, const Real&, std::array<Real, nodes>& s,
                                          std::array<Real, nodes>& ds) {
    const Real zero{};
    s = {1 - xi, xi};
    ds = {zero - 1, zero + 1};
    return zero;
  }
};

/// Generalised interpolation: the mean of the linear function over the particle's extent, which does not change;
/// Bardenhagen & Kober, CMES 5 (2004) 477, with the piecewise form of uniform GIMP. A particle is no wider than a cell.
struct GimpAxis {
  static constexpr int nodes = 3;
  static constexpr int ghostNodes = 1;
  static constexpr bool hasSize = true;
  static double support(double size) { return 1 + 0.5 * size; }

  template <class Real>
  [[gnu::always_inline]] static Real fill(const Real& xi, const Real& size, std::array<Real, nodes>& s,
                                          std::array<Real, nodes>& ds) {
    const Real zero{}, first = xi < 0.5 ? zero - 1 : zero;
    const Real inverse = 1 / size, begin = xi - (first + 1) - 0.5 * size,
               end = begin + size;  // from the middle node on
    const Real fromBelow = positive(-end), toBelow = positive(-begin), fromAbove = positive(begin),
               toAbove = positive(end);
    const Real below = inverse * (toBelow - fromBelow), above = inverse * (toAbove - fromAbove);
    const Real meanBelow = 0.5 * (fromBelow + toBelow), meanAbove = 0.5 * (fromAbove + toAbove);
    s = {below * meanBelow, below * (1 - meanBelow) + above * (1 - meanAbove), above * meanAbove};
    ds = {-below, below - above, above};
    return first;
  }

 private:
  // The particle lies within the cells on either side of its middle node, one part below the node and one above. The
  // mean of a linear function over a part is its value in the middle of the part. The code has no branches and does not
  // subtract large numbers: where a particle barely touches a node, S and its slope are small, and the ratio of force
  // to mass that they determine is accurate only if both are accurate to the last digits.

  template <class Real>
  [[gnu::always_inline]] static Real positive(const Real& r) {
    return r > 0.0 ? r : Real{};
  }
};

/// Quadratic B-splines centred at the nodes; Steffen, Kirby & Berzins, Int. J. Numer. Meth. Engng 76 (2008) 922.
struct QuadraticAxis {
  static constexpr int nodes = 3;
  static constexpr int ghostNodes = 1;
  static constexpr bool hasSize = false;
  static double support(double) { return 1.5; }

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

/// Cubic B-splines centred at the nodes; source as for QuadraticAxis.
struct CubicAxis {
  static constexpr int nodes = 4;
  static constexpr int ghostNodes = 1;
  static constexpr bool hasSize = false;
  static double support(double) { return 2; }

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

}  // namespace tushar::mpm
