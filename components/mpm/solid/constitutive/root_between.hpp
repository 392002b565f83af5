#pragma once

#include <algorithm>
#include <cmath>

namespace tushar::mpm::solid {

/// A root of f between a and b, where f has opposite signs, by the Illinois variant of the method of false position;
/// Dowell & Jarratt, BIT 11 (1971) 168.
template <class Function>
double rootBetween(const Function& f, double a, double b) {
  double fa = f(a), fb = f(b);
  for (int k = 0; k < 100 && fa != 0 && std::abs(b - a) > 1e-14 * std::max(std::abs(a), std::abs(b)); ++k) {
    const double c = b - fb * (b - a) / (fb - fa), fc = f(c);
    if (fc == 0) return c;
    if ((fc > 0) != (fb > 0)) {
      a = b;
      fa = fb;
    } else {
      fa /= 2;
    }
    b = c;
    fb = fc;
  }
  return fa == 0 ? a : b;
}

}  // namespace tushar::mpm::solid
