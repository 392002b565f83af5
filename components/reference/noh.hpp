#pragma once

#include "components/reference/radial_reference.hpp"

namespace tushar::reference {

/// Cold gas that converges on a plane, a line or a point.
struct NohProblem {
  double density = 1;          ///< density at t = 0 [kg/m^3]
  double speed = 1;            ///< inward speed [m/s]
  double pressure = 0;         ///< pressure at t = 0 [Pa]; negligible compared with density speed²
  double gamma = 5.0 / 3;      ///< ratio of specific heats
  Vec3 centre = Vec3::Zero();  ///< centre [m]
  Vec3 round = Vec3(1, 0, 0);  ///< 1 along the 1, 2 or 3 axes in which the distance from the centre is measured
};

/// The exact solution of Noh's problem in d = 1, 2 or 3 dimensions: a shock of speed s = (gamma-1)/2 u0 runs outwards.
///
/// Behind the shock, the gas is at rest with density rho0 ((gamma+1)/(gamma-1))^d and p = (gamma-1)/2 rho u0². Ahead of
/// it, the gas still moves inwards with u0, and has the density rho0 (1 + u0 t / r)^(d-1) at a distance r. An initial
/// pressure is transported with constant p / rho^gamma and has no other effect, so the solution is that of cold gas.
/// Source: W. F. Noh, J. Comput. Phys. 72 (1987) 78.
class Noh : public RadialReference {
 public:
  /// Throws std::invalid_argument if a setting is out of range.
  explicit Noh(const NohProblem& problem);

  double shockRadius(double t) const override { return 0.5 * (problem_.gamma - 1) * problem_.speed * t; }
  RadialState atRadius(double r, double t) const override;

 private:
  NohProblem problem_;
  RadialState behind_;
};

}  // namespace tushar::reference
