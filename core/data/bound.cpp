#include "core/data/bound_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/lanes.hpp"

namespace tushar::data {

namespace {

/// A summary of many numbers, for checking them at once; it is computed in several registers of lanes, independently of
/// each other.
template <bool SeeksLeast>
class Look {
 public:
  Look() {
    least_.fill(1);
    sum_.fill(0);
  }

  void add(const double* values, std::size_t count) {
    std::size_t k = 0;
    if (count >= width) k = addGroups(values, count);
    for (; k + Lanes::count <= count; k += Lanes::count) addTo(least_[0], sum_[0], Lanes::at(values + k));
    for (; k < count; ++k) addTo(last_least_, last_sum_, values[k]);
  }
  /// Whether the numbers certainly satisfy a bound: if their sum is finite, they are finite. The smallest number is
  /// computed only if it is needed: the smallest of 1 and all numbers that are not NaN.
  bool surelyHolds(Bound bound) const {
    Lanes lanesLeast = least_[0], lanesSum = sum_[0];
    for (std::size_t k = 1; k < registers; ++k) {
      lower(lanesLeast, least_[k]);
      lanesSum += sum_[k];
    }
    const double least = std::min(last_least_, -greatest(-lanesLeast)), sum = last_sum_ + total(lanesSum);
    return std::isfinite(sum) && (!SeeksLeast || (bound == Bound::positive ? least > 0 : least >= 0));
  }

 private:
  static constexpr std::size_t registers = 4, width = registers * Lanes::count;
  using Registers = std::array<Lanes, registers>;

  static void lower(double& a, double b) { a = b < a ? b : a; }
  static void lower(Lanes& a, Lanes b) { a = select(b < a, b, a); }
  template <class Numbers>
  static void addTo(Numbers& least, Numbers& sum, Numbers values) {
    if constexpr (SeeksLeast) lower(least, values);
    sum += values;
  }
  /// Adds all complete groups of `width` numbers; returns how many numbers these are.
  std::size_t addGroups(const double* values, std::size_t count) {
    Registers least = least_, sum = sum_;  // copies, which the loop keeps in registers of the processor
    std::size_t k = 0;
    for (; k + width <= count; k += width)
#pragma GCC unroll 4
      for (std::size_t r = 0; r < registers; ++r) addTo(least[r], sum[r], Lanes::at(values + k + r * Lanes::count));
    least_ = least;
    sum_ = sum;
    return k;
  }

  Registers least_, sum_;
  double last_least_ = 1, last_sum_ = 0;
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
