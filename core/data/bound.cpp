#include "core/data/bound_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tushar::data {

namespace {

/// A summary of many numbers, for checking them at once. Independent lanes, for vector instructions, are merged
/// pairwise at the end.
template <bool SeeksLeast>
class Look {
 public:
  Look() { least_.fill(1); }

  void add(const double* values, std::size_t count) {
    std::size_t k = 0;
    for (; k + width <= count; k += width) addTo(0, width, values + k);
    if (k + width / 2 <= count) {
      addTo(0, width / 2, values + k);
      k += width / 2;
    }
    addTo(width / 2, count - k, values + k);
  }
  /// Whether the numbers certainly satisfy a bound: if their sum is finite, they are finite. The smallest number is
  /// computed only if it is needed: the smallest of 1 and all numbers that are not NaN.
  bool surelyHolds(Bound bound) {
    for (std::size_t half = width / 2; half > 0; half /= 2)
      for (std::size_t lane = 0; lane < half; ++lane) {
        lower(least_[lane], least_[lane + half]);
        sum_[lane] += sum_[lane + half];
      }
    return std::isfinite(sum_[0]) && (!SeeksLeast || (bound == Bound::positive ? least_[0] > 0 : least_[0] >= 0));
  }

 private:
  static constexpr std::size_t width = 16;

  static void lower(double& a, double b) { a = b < a ? b : a; }
  void addTo(std::size_t first, std::size_t count, const double* values) {
    for (std::size_t lane = 0; lane < count; ++lane) {
      if constexpr (SeeksLeast) lower(least_[first + lane], values[lane]);
      sum_[first + lane] += values[lane];
    }
  }

  std::array<double, width> least_, sum_{};
};

template <bool SeeksLeast>
bool surelyHolds(Bound bound, NumberRows numbers) {
  Look<SeeksLeast> look;
  for (; numbers.rows > 0; --numbers.rows, numbers.first += numbers.stride) look.add(numbers.first, numbers.count);
  return look.surelyHolds(bound);
}

}  // namespace

bool holds(Bound bound, double value) {
  if (bound == Bound::none) return true;
  return std::isfinite(value) && (bound != Bound::positive || value > 0) && (bound != Bound::nonNegative || value >= 0);
}

bool holds(Bound bound, const NumberRows& numbers) {
  if (bound == Bound::none || numbers.rows == 0) return true;
  if (bound == Bound::finite ? surelyHolds<false>(bound, numbers) : surelyHolds<true>(bound, numbers)) return true;
  bool all = true;
  for (std::size_t row = 0; row < numbers.rows; ++row) {
    const double* values = numbers.first + static_cast<std::ptrdiff_t>(row) * numbers.stride;
    all = all && std::all_of(values, values + numbers.count, [bound](double value) { return holds(bound, value); });
  }
  return all;
}

bool holds(Bound bound, const double* values, std::size_t count) { return holds(bound, {values, count, 1, 0}); }

std::string_view textOf(Bound bound) {
  return bound == Bound::positive ? "greater than 0" : bound == Bound::nonNegative ? "at least 0" : "finite";
}

}  // namespace tushar::data
