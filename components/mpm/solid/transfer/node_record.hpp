#pragma once

#include "core/base/quad.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// The numbers of a node in a step: three components along the kernel axes, a number, three components, a number.
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
  /// Refers to a lane of a record in memory.
  double& operator[](int lane) { return reinterpret_cast<double*>(this)[lane]; }
};

/// Where in a NodeRecord what begins.
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
