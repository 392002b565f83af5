#pragma once

#include <array>

#include "components/reference/gas_reference.hpp"

namespace tushar::reference {

/// A GasState as an array, so that states can be added: density, the three velocities, pressure, energy.
using Fields = Eigen::Array<double, 6, 1, Eigen::DontAlign>;

inline Fields toFields(const GasState& state) {
  Fields fields;
  fields << state.density, state.velocity.array(), state.pressure, state.energy;
  return fields;
}

inline GasState toState(const Fields& fields) {
  return {fields[0], fields.segment<3>(1).matrix(), fields[4], fields[5]};
}

/// Throws std::invalid_argument if upper < lower along any axis.
void checkBox(const Vec3& lower, const Vec3& upper);

/// A point of a quadrature rule on [0, 1]; the weights of a rule sum to 1.
struct QuadraturePoint {
  double at = 0, weight = 0;
};

/// The Gauss-Legendre rule with N points. `half` lists positions and weights on [-1, 1]: one point of each pair and,
/// last if N is odd, the middle.
template <std::size_t N>
constexpr std::array<QuadraturePoint, N> gaussRule(const std::array<QuadraturePoint, (N + 1) / 2>& half) {
  std::array<QuadraturePoint, N> rule;
  for (std::size_t k = 0; k < half.size(); ++k) {
    rule[2 * k] = {0.5 * (1 - half[k].at), 0.5 * half[k].weight};
    if (2 * k + 1 < N) rule[2 * k + 1] = {0.5 * (1 + half[k].at), 0.5 * half[k].weight};
  }
  return rule;
}

// Abramowitz & Stegun, Handbook of Mathematical Functions, table 25.4.
inline constexpr auto kGauss5 = gaussRule<5>({{{0.90617984593866399280, 0.23692688505618908751},
                                               {0.53846931010568309104, 0.47862867049936646804},
                                               {0, 0.56888888888888888889}}});
inline constexpr auto kGauss8 = gaussRule<8>({{{0.18343464249564980494, 0.36268378337836198297},
                                               {0.52553240991632898582, 0.31370664587788728734},
                                               {0.79666647741362673959, 0.22238103445337447054},
                                               {0.96028985649753623168, 0.10122853629037625915}}});

}  // namespace tushar::reference
