#pragma once

#include <Eigen/Core>

#if defined(__AVX__)
#include <immintrin.h>
#endif

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>

namespace tushar {

/// As many numbers as fit into one vector register of the processor. In each lane, an operation on the register is
/// bitwise equal to the operation on a single number, so results do not depend on which numbers share a register.
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
  using Mask = decltype(Register() < Register());  ///< one truth value per lane

  Lanes() = default;
  Lanes(double all) : values_(all - Register{}) {}
  Lanes(Register values) : values_(values) {}
  /// Constructs a register whose lane k contains value(k).
  template <class Value>
  [[gnu::always_inline]] static Lanes of(Value&& value) {
    return fill(value, std::make_integer_sequence<int, count>());
  }

  /// Loads from[k] into lane k.
  static Lanes at(const double* from) {
    Register values;
    std::memcpy(&values, from, sizeof(values));
    return values;
  }

  void copyTo(double* to) const { std::memcpy(to, &values_, sizeof(values_)); }

  double operator[](int lane) const { return values_[lane]; }
  const Register& values() const { return values_; }

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
  /// Returns one register of consecutive lanes from the sequence `low`, `high`, starting at lane `Start` of `low`.
  template <int Start>
  friend Lanes window(Lanes low, Lanes high) {
    return join<Start>(low.values_, high.values_, std::make_integer_sequence<int, count>());
  }
  friend Mask operator>=(Lanes a, Lanes b) { return a.values_ >= b.values_; }
  friend Lanes select(Mask which, Lanes yes, Lanes no) { return which ? yes.values_ : no.values_; }
  /// Loads component `Which` of consecutive vectors with `numbers` components each, stored at `from`: lane k gets the
  /// component of vector k.
  template <int numbers, int Which>
  [[gnu::always_inline]] static Lanes unpacked(const double* from) {
    Register sum = at(from).values_;
    takeRegisters<numbers, Which, 1>(sum, from, std::make_integer_sequence<int, count>());
    return sum;
  }
  /// The inverse of `unpacked`: returns register `Which` of the vectors as they are stored in memory. Element c of `of`
  /// contains component c of all vectors.
  template <int Which, std::size_t numbers>
  [[gnu::always_inline]] static Lanes packed(const std::array<Lanes, numbers>& of) {
    Register sum = of[0].values_;
    takeComponents<Which, 1>(sum, of, std::make_integer_sequence<int, count>());
    return sum;
  }
  friend Mask isNaN(Lanes a) { return a.values_ != a.values_; }
  /// Performs one step of a transposition of two rows: exchanges element c + `step` of the upper row with element c of
  /// the lower row, for all c in which the bit `step` is not set.
  template <int step>
  [[gnu::always_inline]] friend void swapBlocks(Lanes& upper, Lanes& lower) {
    upper.template swapWith<step>(lower, std::make_integer_sequence<int, count>());
  }

 private:
  template <class Value, int... Lane>
  [[gnu::always_inline]] static Lanes fill(Value& value, std::integer_sequence<int, Lane...>) {
    return Register{value(Lane)...};
  }

  template <int Start, int... Lane>
  static Lanes join(Register low, Register high, std::integer_sequence<int, Lane...>) {
    return __builtin_shufflevector(low, high, (Start + Lane)...);
  }

  /// Inserts component Which of the vectors in register Next and in all later registers into `sum`, which already
  /// contains this component of the vectors in earlier registers.
  template <int numbers, int Which, int Next, int... Lane>
  [[gnu::always_inline]] static void takeRegisters(Register& sum, const double* from,
                                                   std::integer_sequence<int, Lane...> lanes) {
    if constexpr (Next < numbers) {
      constexpr auto place = [](int lane) {
        const int element = numbers * lane + Which, in = element / count;
        return in == Next ? count + element % count : Next == 1 && in == 0 ? element % count : lane;
      };
      sum = __builtin_shufflevector(sum, at(from + Next * count).values_, place(Lane)...);
      takeRegisters<numbers, Which, Next + 1>(sum, from, lanes);
    }
  }
  /// Inserts component Next and all later components of register Which into `sum`.
  template <int Which, int Next, std::size_t numbers, int... Lane>
  [[gnu::always_inline]] static void takeComponents(Register& sum, const std::array<Lanes, numbers>& of,
                                                    std::integer_sequence<int, Lane...> lanes) {
    if constexpr (Next < int(numbers)) {
      constexpr auto place = [](int lane) {
        const int element = count * Which + lane, component = element % int(numbers);
        return component == Next             ? count + element / int(numbers)
               : Next == 1 && component == 0 ? element / int(numbers)
                                             : lane;
      };
      sum = __builtin_shufflevector(sum, of[Next].values_, place(Lane)...);
      takeComponents<Which, Next + 1>(sum, of, lanes);
    }
  }
  template <int step, int... Lane>
  [[gnu::always_inline]] void swapWith(Lanes& lower, std::integer_sequence<int, Lane...>) {
    const Register a = values_, b = lower.values_;
    values_ = __builtin_shufflevector(a, b, (Lane & step ? count + Lane - step : Lane)...);
    lower.values_ = __builtin_shufflevector(a, b, (Lane & step ? count + Lane : Lane + step)...);
  }

  Register values_;
};

/// A square block: the number of rows equals the number of lanes.
using LanesSquare = std::array<Lanes, Lanes::count>;

/// Transposes a square block: lane k of row r moves to lane r of row k.
template <int step = Lanes::count / 2>
[[gnu::always_inline]] inline void transpose(LanesSquare& rows) {
#pragma GCC unroll 8
  for (std::size_t r = 0; r < Lanes::count; ++r)
    if ((r & step) == 0) swapBlocks<step>(rows[r], rows[r + step]);
  if constexpr (step > 1) transpose<step / 2>(rows);
}

/// Calls `visit(c)` for squares of Lanes::count columns, the first of which is c, that contain all columns of records
/// of `numbers` numbers, or all but one or two. The last square overlaps the one before if more would be left.
template <int numbers, class Visit>
[[gnu::always_inline]] inline void forEachSquare(Visit&& visit) {
  constexpr int left = numbers % Lanes::count;
#pragma GCC unroll 8
  for (int c = 0; c < numbers - left; c += Lanes::count) visit(c);
  if constexpr (numbers > Lanes::count && left > 2) visit(numbers - Lanes::count);
}
/// The number of columns in these squares.
template <int numbers>
inline constexpr int columnsInSquares = (numbers > Lanes::count && numbers % Lanes::count > 2)
                                            ? numbers
                                            : numbers / Lanes::count* Lanes::count;

/// Loads `numbers` consecutive numbers from the address at(k) for each lane k: lane k of element c of the result is
/// at(k)[c].
template <int numbers, class At>
[[gnu::always_inline]] inline std::array<Lanes, numbers> columnsOf(At&& at) {
  std::array<Lanes, numbers> columns;
  forEachSquare<numbers>([&](int c) __attribute__((always_inline)) {
    LanesSquare rows;
#pragma GCC unroll 8
    for (int k = 0; k < Lanes::count; ++k) rows[k] = Lanes::at(at(k) + c);
    transpose(rows);
#pragma GCC unroll 8
    for (int k = 0; k < Lanes::count; ++k) columns[c + k] = rows[k];
  });
#pragma GCC unroll 8
  for (int c = columnsInSquares<numbers>; c < numbers; ++c) columns[c] = Lanes::of([&](int k) { return at(k)[c]; });
  return columns;
}

/// Like columnsOf, for short records that are contiguous in memory.
template <int numbers, int... Which>
[[gnu::always_inline]] inline std::array<Lanes, numbers> unpack(const double* from,
                                                                std::integer_sequence<int, Which...>) {
  return {Lanes::unpacked<numbers, Which>(from)...};
}
template <int numbers>
[[gnu::always_inline]] inline std::array<Lanes, numbers> unpack(const double* from) {
  return unpack<numbers>(from, std::make_integer_sequence<int, numbers>());
}
/// The inverse of unpack.
template <std::size_t numbers, int... Which>
[[gnu::always_inline]] inline void pack(const std::array<Lanes, numbers>& columns, double* to,
                                        std::integer_sequence<int, Which...>) {
  (Lanes::packed<Which>(columns).copyTo(to + Which * Lanes::count), ...);
}
template <std::size_t numbers>
[[gnu::always_inline]] inline void pack(const std::array<Lanes, numbers>& columns, double* to) {
  pack(columns, to, std::make_integer_sequence<int, int(numbers)>());
}

/// The inverse of columnsOf for the first `count` lanes: at(k)[c] = columns[c] of lane k.
template <std::size_t numbers, class At>
[[gnu::always_inline]] inline void storeColumns(const std::array<Lanes, numbers>& columns, int count, At&& at) {
  forEachSquare<int(numbers)>([&](int c) __attribute__((always_inline)) {
    LanesSquare rows;
#pragma GCC unroll 8
    for (int k = 0; k < Lanes::count; ++k) rows[k] = columns[c + k];
    transpose(rows);
#pragma GCC unroll 8
    for (int k = 0; k < Lanes::count; ++k)
      if (k < count) rows[k].copyTo(at(k) + c);
  });
#pragma GCC unroll 8
  for (int c = columnsInSquares<int(numbers)>; c < int(numbers); ++c)
#pragma GCC unroll 8
    for (int k = 0; k < Lanes::count; ++k)
      if (k < count) at(k)[c] = columns[c][k];
}

/// An integer in each lane.
using LaneIntegers [[gnu::vector_size(Lanes::count * sizeof(int))]] = int;

/// a b + c, rounded once if the processor supports it.
[[gnu::always_inline]] inline Lanes multiplyAdd(Lanes a, Lanes b, Lanes c) {
#if defined(__FMA__) && defined(__AVX512F__)
  return Lanes((Lanes::Register)_mm512_fmadd_pd((__m512d)a.values(), (__m512d)b.values(), (__m512d)c.values()));
#elif defined(__FMA__)
  return Lanes((Lanes::Register)_mm256_fmadd_pd((__m256d)a.values(), (__m256d)b.values(), (__m256d)c.values()));
#else
  return a * b + c;
#endif
}
inline Lanes min(Lanes a, Lanes b) { return select(b < a, b, a); }
inline Lanes max(Lanes a, Lanes b) { return select(a < b, b, a); }
inline Lanes clamp(Lanes x, Lanes low, Lanes high) { return min(max(x, low), high); }
[[gnu::always_inline]] inline Lanes abs(Lanes x) {
  constexpr auto withoutSign = std::numeric_limits<long long>::max();
  return Lanes((Lanes::Register)((Lanes::Mask)x.values() & withoutSign));
}
[[gnu::always_inline]] inline Lanes nearbyint(Lanes x) {
#if defined(__AVX512F__)
  constexpr int nearest = _MM_FROUND_CUR_DIRECTION | _MM_FROUND_NO_EXC;
  return Lanes((Lanes::Register)_mm512_roundscale_pd((__m512d)x.values(), nearest));
#elif defined(__AVX__)
  return Lanes((Lanes::Register)_mm256_round_pd((__m256d)x.values(), _MM_FROUND_NEARBYINT));
#else
  return Lanes::of([&](int lane) { return std::nearbyint(x[lane]); });
#endif
}
[[gnu::always_inline]] inline Lanes widen(LaneIntegers whole) {
  return Lanes(__builtin_convertvector(whole, Lanes::Register));
}
[[gnu::always_inline]] inline Lanes sqrt(Lanes x) {
#if defined(__AVX512F__)
  return Lanes((Lanes::Register)_mm512_sqrt_pd((__m512d)x.values()));
#elif defined(__AVX__)
  return Lanes((Lanes::Register)_mm256_sqrt_pd((__m256d)x.values()));
#else
  return Lanes::of([&](int lane) { return std::sqrt(x[lane]); });
#endif
}
/// Whether a condition is true in every lane.
inline bool all(Lanes::Mask mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask) == 0xFF;
#elif defined(__AVX__)
  return _mm256_movemask_pd((__m256d)mask) == 0xF;
#else
  bool holds = true;
  for (int lane = 0; lane < Lanes::count; ++lane) holds = holds && mask[lane] != 0;
  return holds;
#endif
}
/// Whether a condition is true in any lane.
inline bool any(Lanes::Mask mask) { return !all(~mask); }
/// Combines all lanes into one number: those of the upper half with those of the lower half, then again the halves of
/// the result.
template <int numbers = Lanes::count, class Combine>
[[gnu::always_inline]] inline double combined(Lanes x, Combine&& combine) {
  if constexpr (numbers == 1) {
    return x[0];
  } else {
    return combined<numbers / 2>(combine(x, window<numbers / 2>(x, x)), combine);
  }
}
/// The largest number in any lane.
[[gnu::always_inline]] inline double greatest(Lanes x) {
  return combined(x, [](Lanes low, Lanes high) { return select(low > high, low, high); });
}
/// The sum of all lanes.
[[gnu::always_inline]] inline double total(Lanes x) {
  return combined(x, [](Lanes low, Lanes high) { return low + high; });
}

}  // namespace tushar

/// Allows Lanes as the scalar type of Eigen's vectors and matrices.
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
