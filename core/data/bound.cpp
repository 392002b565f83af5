#include "core/data/bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tushar::data {

namespace {

/// A summary of many numbers, with which all of them are checked together.
struct Look {
  double least;  ///< the smallest number that is not NaN, at most 1; computed only if it is needed
  double sum;    ///< sum of the numbers: not finite if any of them is not finite, or if it overflows
};

/// Summarises numbers in independent lanes, which suit vector instructions, and then merges the lanes pairwise.
template <bool SeeksLeast>
Look lookAt(const double* values, std::size_t count) {
  constexpr std::size_t width = 32;
  std::array<double, width> least, sum{};
  least.fill(1);
  const auto lower = [](double& a, double b) { a = b < a ? b : a; };
  std::size_t k = 0;
  for (; k + width <= count; k += width)
    for (std::size_t lane = 0; lane < width; ++lane) {
      if constexpr (SeeksLeast) lower(least[lane], values[k + lane]);
      sum[lane] += values[k + lane];
    }
  for (; k < count; ++k) {
    if constexpr (SeeksLeast) lower(least[0], values[k]);
    sum[0] += values[k];
  }
  for (std::size_t half = width / 2; half > 0; half /= 2)
    for (std::size_t lane = 0; lane < half; ++lane) {
      if constexpr (SeeksLeast) lower(least[lane], least[lane + half]);
      sum[lane] += sum[lane + half];
    }
  return {least[0], sum[0]};
}

/// Whether the numbers are sure to satisfy a bound; false if this cannot be decided from the sum and the minimum.
bool surelyHolds(Bound bound, const double* values, std::size_t count) {
  if (bound == Bound::finite) return std::isfinite(lookAt<false>(values, count).sum);
  const Look look = lookAt<true>(values, count);
  return std::isfinite(look.sum) && (bound == Bound::positive ? look.least > 0 : look.least >= 0);
}

}  // namespace

bool holds(Bound bound, double value) {
  if (bound == Bound::none) return true;
  return std::isfinite(value) && (bound != Bound::positive || value > 0) && (bound != Bound::nonNegative || value >= 0);
}

bool holds(Bound bound, const double* values, std::size_t count) {
  if (bound == Bound::none || surelyHolds(bound, values, count)) return true;
  return std::all_of(values, values + count, [bound](double value) { return holds(bound, value); });
}

std::string_view textOf(Bound bound) {
  return bound == Bound::positive ? "greater than 0" : bound == Bound::nonNegative ? "at least 0" : "finite";
}

}  // namespace tushar::data
