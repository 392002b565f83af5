#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "components/reference/gas_fields.hpp"

namespace tushar::reference {

/// Returns the largest residual at (x, t) of the gas equations along those `axes` that are 1: d rho/dt + div(rho v),
/// rho Dv/Dt + grad p and Dp/Dt + gamma p div v. Derivatives are central differences of fourth order with step `d`.
inline double gasResidual(const GasReference& gas, const Vec3& x, double t, double gamma, double d,
                          const Vec3& axes = Vec3::Ones()) {
  const auto slope = [&](const Vec3& along, double inTime) -> Fields {
    const auto at = [&](int k) { return toFields(gas.at(x + k * d * along, t + k * d * inTime)); };
    return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * d);
  };
  const Fields here = toFields(gas.at(x, t)), inTime = slope(Vec3::Zero(), 1);
  double mass = inTime[0], pressure = inTime[4];
  Vec3 momentum = here[0] * inTime.segment<3>(1).matrix();
  for (int k = 0; k < 3; ++k) {
    if (axes[k] == 0) continue;
    const Fields along = slope(Vec3::Unit(k), 0);
    const double speed = here[1 + k];
    mass += speed * along[0] + here[0] * along[1 + k];
    momentum += here[0] * speed * along.segment<3>(1).matrix() + along[4] * Vec3::Unit(k);
    pressure += speed * along[4] + gamma * here[4] * along[1 + k];
  }
  return std::max({std::abs(mass), momentum.cwiseAbs().maxCoeff(), std::abs(pressure)});
}

/// Returns the largest difference of any field between two states.
inline double difference(const GasState& a, const GasState& b) { return (toFields(a) - toFields(b)).abs().maxCoeff(); }

/// Returns the mean over a box by n^3 midpoints (one along an axis without extent).
inline GasState midpointMean(const GasReference& gas, const Vec3& lower, const Vec3& upper, double t, int n) {
  std::array<int, 3> count;
  for (int d = 0; d < 3; ++d) count[d] = upper[d] > lower[d] ? n : 1;
  Fields sum = Fields::Zero();
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k) {
        const Vec3 part((i + 0.5) / count[0], (j + 0.5) / count[1], (k + 0.5) / count[2]);
        sum += toFields(gas.at(lower + part.cwiseProduct(upper - lower), t));
      }
  return toState(sum / (count[0] * count[1] * count[2]));
}

}  // namespace tushar::reference
