#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace tushar::mpm::solid {

// Shape functions along one axis, in units of the cell width: `xi` in [0,1] is where the particle stands in its cell,
// `size` its extent. Each fills the values and derivatives at consecutive nodes and returns the first node's number,
// where 0 is the lower node of the cell.

/// Piecewise linear ("tent") functions.
struct LinearAxis {
  static constexpr int nodes = 2;
  static constexpr int ghostNodes = 0;  ///< nodes beyond those of the cell that a particle touches
  static constexpr bool hasSize = false;

  static int fill(double xi, double, std::array<double, nodes>& s, std::array<double, nodes>& ds) {
    s = {1 - xi, xi};
    ds = {-1, 1};
    return 0;
  }
};

/// Generalised interpolation: the mean of the linear function over the particle's extent, which stays as at the start;
/// Bardenhagen & Kober, CMES 5 (2004) 477, with the piecewise form of uniform GIMP.
struct GimpAxis {
  static constexpr int nodes = 3;
  static constexpr int ghostNodes = 1;
  static constexpr bool hasSize = true;

  static int fill(double xi, double size, std::array<double, nodes>& s, std::array<double, nodes>& ds) {
    const int first = xi < 0.5 ? -1 : 0;
    const double inverse = 1 / size, lower = xi - first - 0.5 * size, upper = lower + size;
    for (std::size_t k = 0; k < nodes; ++k) {
      const double a = lower - static_cast<double>(k), b = upper - static_cast<double>(k);
      const double below = overlap(-b, -a), above = overlap(a, b);
      s[k] = inverse * (integral(-b, -a) + integral(a, b));
      ds[k] = inverse * (below - above);
    }
    return first;
  }

 private:
  // Nothing here has branches or takes large numbers from each other: where a particle barely touches a node, S and its
  // slope are small, and the force over the mass that they make is only right if both are right to the last digits.

  static double within(double r) { return std::min(std::max(r, 0.0), 1.0); }
  /// How much of [a,b] lies within [0,1].
  static double overlap(double a, double b) { return within(b) - within(a); }
  /// Of the tent function 1 - r over that.
  static double integral(double a, double b) { return overlap(a, b) * 0.5 * ((1 - within(a)) + (1 - within(b))); }
};

/// Quadratic B-splines about the nodes; Steffen, Kirby & Berzins, Int. J. Numer. Meth. Engng 76 (2008) 922.
struct QuadraticAxis {
  static constexpr int nodes = 3;
  static constexpr int ghostNodes = 1;
  static constexpr bool hasSize = false;

  static int fill(double xi, double, std::array<double, nodes>& s, std::array<double, nodes>& ds) {
    const int first = xi < 0.5 ? -1 : 0;
    const double r = xi - (first + 1), below = 0.5 - r, above = 0.5 + r;
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

  static int fill(double xi, double, std::array<double, nodes>& s, std::array<double, nodes>& ds) {
    const double eta = 1 - xi;
    s = {eta * eta * eta / 6, 2.0 / 3 - xi * xi + xi * xi * xi / 2, 2.0 / 3 - eta * eta + eta * eta * eta / 2,
         xi * xi * xi / 6};
    ds = {-eta * eta / 2, -2 * xi + 1.5 * xi * xi, 2 * eta - 1.5 * eta * eta, xi * xi / 2};
    return -1;
  }
};

}  // namespace tushar::mpm::solid
