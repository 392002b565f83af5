#pragma once

#if defined(__AVX512F__) || defined(__FMA__)
#include <immintrin.h>
#endif

namespace tushar::mpm::solid {

/// Eight numbers that are worked on at once: what a node keeps (see NodeRecord).
using Octet = double __attribute__((vector_size(64)));

/// factor * a + b, rounded once where the processor can.
[[gnu::always_inline]] inline Octet multiplyAdd(double factor, const Octet& a, const Octet& b) {
#if defined(__AVX512F__)
  return (Octet)_mm512_fmadd_pd(_mm512_set1_pd(factor), (__m512d)a, (__m512d)b);
#elif defined(__FMA__)
  const __m256d f = _mm256_set1_pd(factor);
  Octet result;
  auto* to = reinterpret_cast<double*>(&result);
  const auto* x = reinterpret_cast<const double*>(&a);
  const auto* y = reinterpret_cast<const double*>(&b);
  _mm256_store_pd(to, _mm256_fmadd_pd(f, _mm256_load_pd(x), _mm256_load_pd(y)));
  _mm256_store_pd(to + 4, _mm256_fmadd_pd(f, _mm256_load_pd(x + 4), _mm256_load_pd(y + 4)));
  return result;
#else
  return factor * a + b;
#endif
}

}  // namespace tushar::mpm::solid
