#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tushar {

/// A point or vector with D components (in metres unless stated otherwise).
template <int D>
using Vec = Eigen::Matrix<double, D, 1, Eigen::DontAlign>;

/// A vector as written in scenes, [x,y,z]; Level::reduce drops the axes that a scene does not use.
using Vec3 = Vec<3>;

/// Euclidean length; in one dimension computed without a square root.
template <int D>
double length(const Vec<D>& v) {
  if constexpr (D == 1)
    return std::abs(v[0]);
  else
    return v.norm();
}

/// Integer coordinates of a cell or node along D axes.
template <int D>
struct Index {
  std::array<int, D> at{};

  constexpr int& operator[](int axis) { return at[axis]; }
  constexpr int operator[](int axis) const { return at[axis]; }
  /// Compares component by component, because the comparison of std::array would call memcmp.
  friend constexpr bool operator==(const Index& a, const Index& b) {
    bool same = true;
    for (int d = 0; d < D; ++d) same &= a[d] == b[d];
    return same;
  }

  friend constexpr Index operator+(Index a, const Index& b) {
    for (int d = 0; d < D; ++d) a[d] += b[d];
    return a;
  }
  friend constexpr Index operator*(Index a, int factor) {
    for (int& one : a.at) one *= factor;
    return a;
  }
  friend constexpr Index operator-(Index a, const Index& b) {
    for (int d = 0; d < D; ++d) a[d] -= b[d];
    return a;
  }

  static constexpr Index filled(int value) {
    Index index;
    index.at.fill(value);
    return index;
  }
  /// The index that is 1 along `axis` and 0 along the others.
  static constexpr Index unit(int axis) {
    Index index;
    index[axis] = 1;
    return index;
  }
};

using Index3 = Index<3>;

/// Identifies a particle as long as it exists; the ids of new particles derive from those of their parents.
using ParticleId = std::uint64_t;

}  // namespace tushar
