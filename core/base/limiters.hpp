#pragma once

#include <cmath>

#include "core/base/lanes.hpp"

namespace tushar {

/// Returns `yes` if a condition holds, otherwise `no`; the function of this name for Lanes decides in each lane.
inline double select(bool which, double yes, double no) { return which ? yes : no; }

// Slopes of a cell, computed from the differences `a` and `b` to its two neighbours. All of these functions are
// symmetric, f(a, b) = f(b, a), odd, f(-a, -b) = -f(a, b), zero at extrema, and TVD: |f| <= 2 min(|a|, |b|). `half`
// returns half of the slope; its numbers are double or Lanes.
// Source: B. van Leer, J. Comput. Phys. 23 (1977) 276 and 32 (1979) 101; Toro, section 14.4.

/// Returns the difference of smaller magnitude; 0 at extrema.
struct Minmod {
  template <class Number>
  static Number half(const Number& a, const Number& b) {
    using std::abs;
    const Number least = select(abs(a) < abs(b), a, b);
    return select(a * b > 0.0, 0.5 * least, 0.0);
  }
  static double slope(double a, double b) { return 2 * half(a, b); }
};

/// Returns the harmonic mean, 2 a b / (a + b).
struct VanLeer {
  template <class Number>
  static Number half(const Number& a, const Number& b) {
    const Number product = a * b;
    const Number ratio = product / (a + b);
    return select(product > 0.0, ratio, 0.0);
  }
  static double slope(double a, double b) { return 2 * half(a, b); }
};

/// Returns the mean, but at most twice the smaller difference (monotonised central).
struct Mc {
  template <class Number>
  static Number half(const Number& a, const Number& b) {
    using std::abs;
    const Number least = select(abs(a) < abs(b), a, b);
    const Number mean = 0.25 * (a + b);
    const Number half = select(abs(mean) < abs(least), mean, least);
    return select(a * b > 0.0, half, 0.0);
  }
  static double slope(double a, double b) { return 2 * half(a, b); }
};

}  // namespace tushar
