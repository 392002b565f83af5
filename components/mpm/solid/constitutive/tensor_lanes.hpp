#pragma once

#include <algorithm>
#include <array>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "core/base/lanes.hpp"
#include "core/base/quad.hpp"

namespace tushar::mpm::solid {

template <class Real>
[[gnu::always_inline]] inline Real determinant(const TensorOf<Real>& f) {
  return f(0, 0) * (f(1, 1) * f(2, 2) - f(1, 2) * f(2, 1)) - f(0, 1) * (f(1, 0) * f(2, 2) - f(1, 2) * f(2, 0)) +
         f(0, 2) * (f(1, 0) * f(2, 1) - f(1, 1) * f(2, 0));
}

/// Computes F Fᵀ.
template <class Real>
[[gnu::always_inline]] inline TensorOf<Real> leftCauchyGreen(const TensorOf<Real>& f) {
  TensorOf<Real> b;
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k) b(i, k) = b(k, i) = f(i, 0) * f(k, 0) + f(i, 1) * f(k, 1) + f(i, 2) * f(k, 2);
  return b;
}

template <class Real>
[[gnu::always_inline]] inline Real trace(const TensorOf<Real>& t) {
  return t(0, 0) + (t(1, 1) + t(2, 2));
}

/// sum_ij t_ij², bitwise equal to Eigen's result for a single tensor.
template <class Real>
[[gnu::always_inline]] inline Real squaredNorm(const TensorOf<Real>& t) {
  std::array<Real, 9> square;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) square[3 * i + k] = t(i, k) * t(i, k);
  const Real even = (square[0] + square[2]) + (square[4] + square[6]);
  const Real odd = (square[1] + square[3]) + (square[5] + square[7]);
  return even + odd + square[8];
}

/// Loads the next Lanes::count of `count` consecutive tensors; missing ones repeat the last one.
[[gnu::always_inline]] inline TensorOf<Lanes> lanesOf(const Matrix3* tensors, int count) {
  const std::array<Lanes, 9> numbers =
      columnsOf<9>([&](int lane) { return tensors[count < Lanes::count ? std::min(lane, count - 1) : lane].data(); });
  TensorOf<Lanes> t;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) t(i, k) = numbers[3 * i + k];
  return t;
}

/// Stores the first `count` tensors of the lanes, at most Lanes::count, consecutively.
[[gnu::always_inline]] inline void storeLanes(const TensorOf<Lanes>& t, Matrix3* tensors, int count) {
  std::array<Lanes, 9> numbers;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) numbers[3 * i + k] = t(i, k);
  storeColumns(numbers, count, [&](int lane) { return tensors[lane].data(); });
}

/// The rows of a tensor; lane 3 is undefined.
struct Rows {
  Quad row[3];

  explicit Rows(const Matrix3& t) {
    Quad last;
    std::memcpy(&row[0], t.data(), sizeof(Quad));
    std::memcpy(&row[1], t.data() + 3, sizeof(Quad));
    std::memcpy(&last, t.data() + 5, sizeof(Quad));
    row[2] = __builtin_shufflevector(last, last, 1, 2, 3, 3);
  }
  void copyTo(Matrix3& t) const {
    const Quad last = __builtin_shufflevector(row[1], row[2], 2, 4, 5, 6);
    std::memcpy(t.data(), &row[0], sizeof(Quad));
    std::memcpy(t.data() + 3, &row[1], sizeof(Quad));
    std::memcpy(t.data() + 5, &last, sizeof(Quad));
  }
};

}  // namespace tushar::mpm::solid
