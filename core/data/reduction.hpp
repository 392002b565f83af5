#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/base/vec.hpp"
#include "core/data/label.hpp"

namespace tushar::data {

/// A short text that says where a value comes from, such as `CFL`. It contains no pointers, so that its bytes can be
/// sent.
class Reason {
 public:
  constexpr Reason() = default;
  /// Constructs a reason from a literal of at most 31 characters.
  template <std::size_t N>
  constexpr Reason(const char (&words)[N]) {
    static_assert(N <= std::tuple_size_v<decltype(letters_)>, "a reason must have at most 31 characters");
    for (std::size_t k = 0; k < N; ++k) letters_[k] = words[k];
  }
  /// Constructs a reason from any text, cut off after 31 characters.
  static Reason of(std::string_view words) {
    Reason reason;
    words.copy(reason.letters_.data(), reason.letters_.size() - 1);
    return reason;
  }
  constexpr std::string_view text() const { return letters_.data(); }

  friend constexpr auto operator<=>(const Reason&, const Reason&) = default;

 private:
  std::array<char, 32> letters_{};
};

/// The minimum of all values, with its reason if one is given; +infinity if there are no values. If values are equal,
/// the reason that comes first in the alphabet is kept, so that the order in which values are added does not matter.
struct Minimum {
  double value = std::numeric_limits<double>::infinity();
  Reason reason{};

  void add(double x, const Reason& why = {}) {
    if (x < value || (x == value && why < reason)) {
      value = x;
      reason = why;
    }
  }
  void merge(const Minimum& other) { add(other.value, other.reason); }
  std::vector<double> values() const { return {value}; }
};

/// The maximum of all values; -infinity if there are none.
struct Maximum {
  double value = -std::numeric_limits<double>::infinity();

  void add(double x) {
    if (x > value) value = x;
  }
  void merge(const Maximum& other) { add(other.value); }
  std::vector<double> values() const { return {value}; }
};

/// Replaces `a` by the rounded sum of both, and `b` by the exact rounding error (D. E. Knuth, The Art of Computer
/// Programming 2, 4.2.2, theorem B). For registers, lane by lane.
template <class Number>
void addExactly(Number& a, Number& b) {
  const Number sum = a + b;
  const Number part = sum - a;
  b = (a - (sum - part)) + (b - part);
  a = sum;
}

/// A sum with about 48 digits: it accumulates the rounding error of each addition, and in turn the rounding errors of
/// these additions. Its 16 leading digits do not depend on the order of the additions, even if the terms nearly cancel.
struct Sum {
  double value = 0, error = 0, rest = 0;

  void add(double x) {
    addExactly(value, x);
    addExactly(error, x);
    rest += x;
  }
  /// After the merge, each part is the rounding error of the previous one, so that equal sums are bitwise equal.
  void merge(const Sum& other) {
    add(other.value);
    double x = other.error;
    addExactly(error, x);
    rest += x + other.rest;
    separate();
  }
  double total() const {
    Sum parts = *this;
    parts.separate();  // else, rounding the sum of the errors counts where they nearly cancel the value
    return parts.value + (parts.error + parts.rest);
  }
  std::vector<double> values() const { return {total()}; }

 private:
  /// Makes each part the rounding error of the previous one, with the same exact sum.
  void separate() {
    addExactly(error, rest);
    addExactly(value, error);
    addExactly(error, rest);
  }
};

/// A sum of vectors with components x, y, z.
struct VectorSum {
  Sum x, y, z;

  void add(const Vec3& v) {
    x.add(v[0]);
    y.add(v[1]);
    z.add(v[2]);
  }
  void merge(const VectorSum& other) {
    x.merge(other.x);
    y.merge(other.y);
    z.merge(other.z);
  }
  std::vector<double> values() const { return {x.total(), y.total(), z.total()}; }
};

/// Norms of an error over the places at which it is added, with equal weights by default: L1 = mean |e|, L2 = sqrt(mean
/// e²), max |e| and, if exact values are given, L1 divided by their mean magnitude.
struct Norm {
  Sum absolute, squared, count, exact;
  double max = 0;

  /// `weight`: weight of the place, such as Level::weight(); a power of two, so that weighting causes no rounding.
  void add(double e, double magnitude = 0, double weight = 1) {
    exact.add(weight * std::abs(magnitude));
    absolute.add(weight * std::abs(e));
    squared.add(weight * (e * e));
    count.add(weight);
    max = std::abs(e) > max || std::isnan(e) ? std::abs(e) : max;
  }
  void merge(const Norm& other) {
    absolute.merge(other.absolute);
    squared.merge(other.squared);
    count.merge(other.count);
    exact.merge(other.exact);
    max = other.max > max || std::isnan(other.max) ? other.max : max;
  }
  double l1() const { return absolute.total() / count.total(); }
  double l2() const { return std::sqrt(squared.total() / count.total()); }
  double relative() const { return absolute.total() / exact.total(); }
  std::vector<double> values() const { return {l1(), l2(), max, relative()}; }
};

/// The time step [s]; tasks of scheduleComputeStableTimeStep lower it, each with the name of its limit as the reason.
inline constexpr ReductionLabel<Minimum> delT{"delT", "s", "time step"};

/// The largest factor by which the time step may be multiplied without violating a bound. If a task of
/// scheduleTimeAdvance computes a value below 1, the step is undone and repeated with a smaller time step; the reason
/// names the bound. The step ends with this task, so that no later task reads the invalid values. The old state is
/// preserved.
inline constexpr ReductionLabel<Minimum> recomputeTimeStep{
    "recomputeTimeStep", "1", "factor by which to multiply the time step so that every bound holds"};

}  // namespace tushar::data
