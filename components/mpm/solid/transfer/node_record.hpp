#pragma once

#include "core/base/quad.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// The numbers that a node stores in a step: three components along the kernel axes, a number, three components, a
/// number.
///
/// | lanes | from particles | before contact | at the end of the step |
/// |---|---|---|---|
/// | 0-2 | momentum | velocity v | velocity v* |
/// | 3 | mass | mass | mass |
/// | 4-6 | force | force | velocity v |
/// | 7 | volume | volume | volume |
///
/// The two halves are named so that the compiler keeps each in a register of its own, and so that a kernel which needs
/// one of them works on that alone.
struct alignas(64) NodeRecord {
  Quad low, high;

  double operator[](int lane) const { return lane < 4 ? low[lane] : high[lane - 4]; }
  /// Refers to one lane of a record in memory.
  double& operator[](int lane) { return reinterpret_cast<double*>(this)[lane]; }
};

/// A NodeRecord in registers; in a single one if it is wide enough for both halves.
class Octet {
 public:
#if defined(__AVX512F__) && defined(__FMA__)
  Octet() = default;
  [[gnu::always_inline]] explicit Octet(const NodeRecord& r) : both_(_mm512_load_pd(&r)) {}
  [[gnu::always_inline]] Octet(const Quad& low, const Quad& high)
      : both_(_mm512_insertf64x4(_mm512_castpd256_pd512((__m256d)low), (__m256d)high, 1)) {}
  [[gnu::always_inline]] void copyTo(NodeRecord& r) const { _mm512_store_pd(&r, both_); }
  [[gnu::always_inline]] Quad low() const { return (Quad)_mm512_castpd512_pd256(both_); }
  [[gnu::always_inline]] friend Octet operator*(double factor, const Octet& a) {
    return _mm512_mul_pd(_mm512_set1_pd(factor), a.both_);
  }
  /// Computes factor * a + b, rounded once.
  [[gnu::always_inline]] friend Octet multiplyAdd(double factor, const Octet& a, const Octet& b) {
    return _mm512_fmadd_pd(_mm512_set1_pd(factor), a.both_, b.both_);
  }
  /// Returns b with factor * a added to its high half, rounded once.
  [[gnu::always_inline]] friend Octet multiplyAddHigh(double factor, const Octet& a, const Octet& b) {
    return _mm512_mask3_fmadd_pd(_mm512_set1_pd(factor), a.both_, b.both_, 0xF0);
  }

 private:
  Octet(__m512d both) : both_(both) {}
  __m512d both_ = _mm512_setzero_pd();
#else
  Octet() = default;
  [[gnu::always_inline]] explicit Octet(const NodeRecord& r) : low_(r.low), high_(r.high) {}
  [[gnu::always_inline]] Octet(const Quad& low, const Quad& high) : low_(low), high_(high) {}
  [[gnu::always_inline]] void copyTo(NodeRecord& r) const { r.low = low_, r.high = high_; }
  [[gnu::always_inline]] Quad low() const { return low_; }
  [[gnu::always_inline]] Quad high() const { return high_; }
  [[gnu::always_inline]] friend Octet operator*(double factor, const Octet& a) {
    return {factor * a.low_, factor * a.high_};
  }
  /// Computes factor * a + b, rounded once if the processor supports it.
  [[gnu::always_inline]] friend Octet multiplyAdd(double factor, const Octet& a, const Octet& b) {
    return {multiplyAdd(factor, a.low_, b.low_), multiplyAdd(factor, a.high_, b.high_)};
  }
  /// Returns b with factor * a added to its high half, rounded once if the processor supports it.
  [[gnu::always_inline]] friend Octet multiplyAddHigh(double factor, const Octet& a, const Octet& b) {
    return {b.low_, multiplyAdd(factor, a.high_, b.high_)};
  }

 private:
  Quad low_{}, high_{};
#endif
};

/// The index of the first lane of each quantity in a NodeRecord.
namespace lane {
inline constexpr int velocity = 0, mass = 3, force = 4, before = 4, volume = 7;
}

template <int D>
Vec<D> lanes(const NodeRecord& record, int first) {
  Vec<D> v;
  for (int d = 0; d < D; ++d) v[d] = record[first + d];
  return v;
}
template <int D>
void setLanes(NodeRecord& record, int first, const Vec<D>& v) {
  for (int d = 0; d < D; ++d) record[first + d] = v[d];
}

}  // namespace tushar::mpm::solid

namespace tushar::data {
template <>
struct Stored<mpm::solid::NodeRecord> {
  static constexpr Number number = Number::real;
  static constexpr int components = 8;
  static constexpr bool isVector = false;
};
}  // namespace tushar::data
