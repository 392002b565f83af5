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
      const double a = within(lower - static_cast<double>(k)), b = within(upper - static_cast<double>(k));
      s[k] = inverse * (integral(b) - integral(a));
      ds[k] = inverse * (std::abs(a) - std::abs(b));
    }
    return first;
  }

 private:
  /// A distance from the node, brought to where the tent function is not 0: what follows has no branches.
  static double within(double r) { return std::min(std::max(r, -1.0), 1.0); }
  /// Of the tent function 1 - |r|, from the node on.
  static double integral(double r) { return r - 0.5 * r * std::abs(r); }
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
