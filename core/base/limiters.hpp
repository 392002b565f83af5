#pragma once

#include <cmath>

namespace tushar {

// Slopes of a cell, computed from the differences `a` and `b` to its two neighbours. All of these functions are
// symmetric, f(a, b) = f(b, a), odd, f(-a, -b) = -f(a, b), zero at extrema, and TVD: |f| <= 2 min(|a|, |b|).
// Source: B. van Leer, J. Comput. Phys. 23 (1977) 276 and 32 (1979) 101; Toro, section 14.4.

/// Returns the difference of smaller magnitude; 0 at extrema.
struct Minmod {
  static double slope(double a, double b) {
    const double least = std::abs(a) < std::abs(b) ? a : b;
    return a * b > 0 ? least : 0.0;
  }
};

/// Returns the harmonic mean, 2 a b / (a + b).
struct VanLeer {
  static double slope(double a, double b) {
    const double product = a * b;
    const double sum = a + b;
    const double harmonic = 2 * product / (product > 0 ? sum : 1.0);
    return product > 0 ? harmonic : 0.0;
  }
};

/// Returns the mean, but at most twice the smaller difference (monotonised central).
struct Mc {
  static double slope(double a, double b) {
    const double least = 2 * (std::abs(a) < std::abs(b) ? a : b);
    const double mean = 0.5 * (a + b);
    const double slope = std::abs(mean) < std::abs(least) ? mean : least;
    return a * b > 0 ? slope : 0.0;
  }
};

}  // namespace tushar
