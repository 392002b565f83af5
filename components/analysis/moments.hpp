#pragma once

#include <utility>

#include "core/base/vec.hpp"

// Means and central moments over time, one sample after the other.

namespace tushar::analysis {

/// The sums over samples of a variable with N numbers per cell, one row for each: the mean; the sum of squared
/// deviations from it; and, if K is 4, the sums of their third and fourth powers.
template <int N, int K>
using Moments = Eigen::Matrix<double, N, K, Eigen::RowMajor | Eigen::DontAlign>;

/// Adds a sample to the sums over n - 1 samples. The deviations are taken from the mean so far, so that a small
/// variance beside a great mean keeps its digits. Source: B. P. Welford, Technometrics 4 (1962) 419; P. Pébay, Sandia
/// report SAND2008-6212 (2008), for the third and fourth powers.
template <int N, int K>
Moments<N, K> withSample(Moments<N, K> sums, const Vec<N>& sample, double n) {
  static_assert(K == 2 || K == 4);
  const Vec<N> delta = sample - sums.col(0), part = delta / n;
  const Vec<N> square = (n - 1) * delta.cwiseProduct(part);
  const Vec<N> squares = sums.col(1);
  if constexpr (K == 4) {
    const Vec<N> cubes = sums.col(2), partSquare = part.cwiseProduct(part);
    sums.col(3) += square.cwiseProduct(partSquare) * (n * n - 3 * n + 3) + 6 * partSquare.cwiseProduct(squares) -
                   4 * part.cwiseProduct(cubes);
    sums.col(2) += square.cwiseProduct(part) * (n - 2) - 3 * part.cwiseProduct(squares);
  }
  sums.col(1) += square;
  sums.col(0) += part;
  return sums;
}

/// The products of a quantity with a velocity, along x, y, z: those of a number q with each component, (q u, q v, q w);
/// of a vector (a, b, c), the mixed ones (a v, b w, c u), which for the velocity itself are those of shear.
inline Vec3 productsWith(double q, const Vec3& velocity) { return q * velocity; }
inline Vec3 productsWith(const Vec3& q, const Vec3& velocity) {
  return {q[0] * velocity[1], q[1] * velocity[2], q[2] * velocity[0]};
}

/// Adds a sample to the sums of products of deviations over n - 1 samples (Pébay 2008). `q` and `velocity` are the
/// deviations of the sample from the means of the n - 1 samples before it.
template <class Q>
Vec3 withProducts(const Vec3& sums, const Q& q, const Vec3& velocity, double n) {
  return sums + (n - 1) / n * productsWith(q, velocity);
}

}  // namespace tushar::analysis
