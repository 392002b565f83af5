#pragma once

#if defined(__FMA__)
#include <immintrin.h>
#endif

#include "core/base/vec.hpp"

namespace tushar {

/// Four numbers in one vector register, or in two that hold two numbers each.
using Quad = double __attribute__((vector_size(32)));
using QuadOfIntegers = int __attribute__((vector_size(16)));

/// factor * a + b, rounded once if the processor supports it.
[[gnu::always_inline]] inline Quad multiplyAdd(double factor, const Quad& a, const Quad& b) {
#if defined(__FMA__)
  return (Quad)_mm256_fmadd_pd(_mm256_set1_pd(factor), (__m256d)a, (__m256d)b);
#else
  return factor * a + b;
#endif
}

/// factor * a + b with a factor for each lane.
[[gnu::always_inline]] inline Quad multiplyAdd(const Quad& factor, const Quad& a, const Quad& b) {
#if defined(__FMA__)
  return (Quad)_mm256_fmadd_pd((__m256d)factor, (__m256d)a, (__m256d)b);
#else
  return factor * a + b;
#endif
}

/// The components of a vector, padded with zeros, and a number in the last lane.
template <int D>
[[gnu::always_inline]] inline Quad quadOf(const Vec<D>& v, double number = 0) {
  if constexpr (D == 1)
    return Quad{v[0], 0, 0, number};
  else if constexpr (D == 2)
    return Quad{v[0], v[1], 0, number};
  else
    return Quad{v[0], v[1], v[2], number};
}

}  // namespace tushar
