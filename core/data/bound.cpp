#include "core/data/bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tushar::data {

namespace {

/// What is looked at of many numbers at once.
struct Look {
  double least;  ///< of those that are numbers, or 1
  double zero;   ///< the sum of 0 times each: not a number where one is not finite
};

/// Lanes that do not wait for one another, for vector instructions.
Look lookAt(const double* values, std::size_t count) {
  constexpr std::size_t width = 32;
  std::array<double, width> least, zero{};
  least.fill(1);
  std::size_t k = 0;
  for (; k + width <= count; k += width)
    for (std::size_t lane = 0; lane < width; ++lane) {
      const double x = values[k + lane];
      least[lane] = x < least[lane] ? x : least[lane];
      zero[lane] += 0 * x;
    }
  for (; k < count; ++k) {
    least[0] = std::min(least[0], values[k]);
    zero[0] += 0 * values[k];
  }
  for (std::size_t lane = 1; lane < width; ++lane) {
    least[0] = std::min(least[0], least[lane]);
    zero[0] += zero[lane];
  }
  return {least[0], zero[0]};
}

}  // namespace

bool holds(Bound bound, double value) {
  if (bound == Bound::none) return true;
  return std::isfinite(value) && (bound != Bound::positive || value > 0) && (bound != Bound::nonNegative || value >= 0);
}

bool holds(Bound bound, const double* values, std::size_t count) {
  if (bound == Bound::none) return true;
  const Look look = lookAt(values, count);
  return look.zero == 0 && (bound != Bound::positive || look.least > 0) && (bound != Bound::nonNegative || look.least >= 0);
}

std::string_view textOf(Bound bound) {
  return bound == Bound::positive ? "greater than 0" : bound == Bound::nonNegative ? "at least 0" : "finite";
}

}  // namespace tushar::data
