#pragma once

#include "components/reference/vortex.hpp"

namespace tushar::reference {

/// A smooth vortex that moves with a uniform flow.
struct IsentropicVortexProblem : VortexProblem {
  double strength = 5;  ///< beta [m/s]: the largest speed around the centre is beta / 2 pi
};

/// The exact solution of the isentropic vortex.
///
/// With s = distance from the axis / radius and f = beta / 2 pi exp((1 - s²) / 2), the velocity around the axis is f s,
/// p / rho = p0 / rho0 - (gamma-1) / (2 gamma) f², and p / rho^gamma is uniform. Where the grid repeats, the values are
/// those of the nearest image. Source: C.-W. Shu, ICASE report 97-65 (1997), section 5.1, here with units.
class IsentropicVortex : public GasReference {
 public:
  /// Throws std::invalid_argument if a setting is out of range, or if the vortex is so strong that its centre is empty.
  explicit IsentropicVortex(const IsentropicVortexProblem& problem);

  GasState at(const Vec3& x, double t) const override;
  /// Uses piecewiseMean, split half-way between images; accurate to 1e-12 in boxes no wider than a third of the radius.
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;

 private:
  IsentropicVortexProblem problem_;
  double temperature_;  ///< p0 / rho0 [m²/s²]
};

}  // namespace tushar::reference
