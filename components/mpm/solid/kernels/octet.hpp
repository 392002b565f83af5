#pragma once

#if defined(__FMA__)
#include <immintrin.h>
#endif

#include "core/core.hpp"

namespace tushar::mpm::solid {

/// Four numbers that are worked on at once: a register, or two where the processor's hold two numbers.
using Quad = double __attribute__((vector_size(32)));
using QuadOfIntegers = int __attribute__((vector_size(16)));

/// factor * a + b, rounded once where the processor can.
[[gnu::always_inline]] inline Quad multiplyAdd(double factor, const Quad& a, const Quad& b) {
#if defined(__FMA__)
  return (Quad)_mm256_fmadd_pd(_mm256_set1_pd(factor), (__m256d)a, (__m256d)b);
#else
  return factor * a + b;
#endif
}

/// The same with a factor for each lane.
[[gnu::always_inline]] inline Quad multiplyAdd(const Quad& factor, const Quad& a, const Quad& b) {
#if defined(__FMA__)
  return (Quad)_mm256_fmadd_pd((__m256d)factor, (__m256d)a, (__m256d)b);
#else
  return factor * a + b;
#endif
}

/// The same number four times.
[[gnu::always_inline]] inline Quad quadOf(double number) { return Quad{number, number, number, number}; }

/// Lane `Which` four times.
template <int Which>
[[gnu::always_inline]] inline Quad spread(const Quad& a) {
  return __builtin_shufflevector(a, a, Which, Which, Which, Which);
}

/// Eight numbers: what a node keeps (see NodeRecord). The two halves are named so that the compiler keeps each in a
/// register of its own, and so that a kernel which needs one of them works on that alone.
struct alignas(64) Octet {
  Quad low, high;

  double operator[](int lane) const { return lane < 4 ? low[lane] : high[lane - 4]; }
  /// Of an Octet in memory; one in registers is made by octetOf.
  double& operator[](int lane) { return reinterpret_cast<double*>(this)[lane]; }
};

/// The components of a vector, zeros behind them, and a number.
template <int D>
[[gnu::always_inline]] inline Quad quadOf(const Vec<D>& v, double number = 0) {
  if constexpr (D == 1)
    return Quad{v[0], 0, 0, number};
  else if constexpr (D == 2)
    return Quad{v[0], v[1], 0, number};
  else
    return Quad{v[0], v[1], v[2], number};
}

}  // namespace tushar::mpm::solid
