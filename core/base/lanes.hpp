#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

namespace tushar {

/// As many numbers as the processor's vector registers hold. An operation acts on each of them as it does on a number
/// alone, to the same bits, so that results do not depend on which numbers share a register.
class Lanes {
 public:
#if defined(__AVX512F__)
  static constexpr int count = 8;
#elif defined(__AVX__)
  static constexpr int count = 4;
#else
  static constexpr int count = 2;
#endif
  using Register [[gnu::vector_size(count * sizeof(double))]] = double;
  using Mask = decltype(Register() < Register());  ///< true or false in each lane

  Lanes() = default;
  Lanes(double all) : values_(all - Register{}) {}
  Lanes(Register values) : values_(values) {}
  /// Lane k holds value(k).
  template <class Value>
  static Lanes of(Value&& value) {
    return fill(value, std::make_integer_sequence<int, count>());
  }

  /// Lane k holds from[k].
  static Lanes at(const double* from) {
    Register values;
    std::memcpy(&values, from, sizeof(values));
    return values;
  }

  void copyTo(double* to) const { std::memcpy(to, &values_, sizeof(values_)); }

  double operator[](int lane) const { return values_[lane]; }

  Lanes operator-() const { return -values_; }
  Lanes& operator+=(Lanes b) { return *this = *this + b; }
  Lanes& operator-=(Lanes b) { return *this = *this - b; }
  Lanes& operator*=(Lanes b) { return *this = *this * b; }
  Lanes& operator/=(Lanes b) { return *this = *this / b; }
  friend Lanes operator+(Lanes a, Lanes b) { return a.values_ + b.values_; }
  friend Lanes operator-(Lanes a, Lanes b) { return a.values_ - b.values_; }
  friend Lanes operator*(Lanes a, Lanes b) { return a.values_ * b.values_; }
  friend Lanes operator/(Lanes a, Lanes b) { return a.values_ / b.values_; }
  friend Mask operator<(Lanes a, Lanes b) { return a.values_ < b.values_; }
  friend Mask operator>(Lanes a, Lanes b) { return a.values_ > b.values_; }
  /// The lanes of `low` and `high` side by side, from lane `Start` of `low` on.
  template <int Start>
  friend Lanes window(Lanes low, Lanes high) {
    return join<Start>(low.values_, high.values_, std::make_integer_sequence<int, count>());
  }
  friend Mask operator>=(Lanes a, Lanes b) { return a.values_ >= b.values_; }
  friend Lanes select(Mask which, Lanes yes, Lanes no) { return which ? yes.values_ : no.values_; }

 private:
  template <class Value, int... Lane>
  static Lanes fill(Value& value, std::integer_sequence<int, Lane...>) {
    return Register{value(Lane)...};
  }

  template <int Start, int... Lane>
  static Lanes join(Register low, Register high, std::integer_sequence<int, Lane...>) {
    return __builtin_shufflevector(low, high, (Start + Lane)...);
  }

  Register values_;
};

/// An integer in each lane.
using LaneIntegers [[gnu::vector_size(Lanes::count * sizeof(int))]] = int;

inline Lanes min(Lanes a, Lanes b) { return select(b < a, b, a); }
inline Lanes max(Lanes a, Lanes b) { return select(a < b, b, a); }
inline Lanes clamp(Lanes x, Lanes low, Lanes high) { return min(max(x, low), high); }
inline Lanes abs(Lanes x) {
  return Lanes::of([&](int lane) { return std::abs(x[lane]); });
}
inline Lanes floor(Lanes x) {
  return Lanes::of([&](int lane) { return std::floor(x[lane]); });
}
inline Lanes nearbyint(Lanes x) {
  return Lanes::of([&](int lane) { return std::nearbyint(x[lane]); });
}
inline LaneIntegers truncate(Lanes x) {
  LaneIntegers whole;
  for (int lane = 0; lane < Lanes::count; ++lane) whole[lane] = static_cast<int>(x[lane]);
  return whole;
}
inline Lanes widen(LaneIntegers whole) {
  return Lanes::of([&](int lane) { return static_cast<double>(whole[lane]); });
}
inline Lanes sqrt(Lanes x) {
  return Lanes::of([&](int lane) { return std::sqrt(x[lane]); });
}
/// Whether something holds in the first `count` lanes.
inline bool all(Lanes::Mask mask, int count) {
  bool holds = true;
  for (int lane = 0; lane < count; ++lane) holds = holds && mask[lane] != 0;
  return holds;
}
/// The greatest of all lanes.
inline double greatest(Lanes x) {
  constexpr int half = Lanes::count / 2;
  std::array<double, half> most;
  for (int lane = 0; lane < half; ++lane) most[lane] = x[lane] > x[lane + half] ? x[lane] : x[lane + half];
  for (int width = half / 2; width > 0; width /= 2)
    for (int lane = 0; lane < width; ++lane)
      most[lane] = most[lane] > most[lane + width] ? most[lane] : most[lane + width];
  return most[0];
}

}  // namespace tushar

/// Lets Eigen's vectors and matrices hold Lanes.
namespace Eigen {
template <>
struct NumTraits<tushar::Lanes> : NumTraits<double> {
  using Real = tushar::Lanes;
  using NonInteger = tushar::Lanes;
  using Nested = tushar::Lanes;
};
template <class Operation>
struct ScalarBinaryOpTraits<double, tushar::Lanes, Operation> {
  using ReturnType = tushar::Lanes;
};
template <class Operation>
struct ScalarBinaryOpTraits<tushar::Lanes, double, Operation> {
  using ReturnType = tushar::Lanes;
};
}  // namespace Eigen
