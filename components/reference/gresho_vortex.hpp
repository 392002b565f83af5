#pragma once

#include "components/reference/vortex.hpp"

namespace tushar::reference {

/// A vortex of two rings that moves with a uniform flow; pressure balances the centrifugal force.
struct GreshoProblem : VortexProblem {
  /// The default problem: a radius of 0.2 m and 5 Pa in the middle. Beyond twice the radius, the gas does not rotate.
  GreshoProblem() {
    pressure = 5;
    radius = 0.2;
  }
  double speed = 1;  ///< largest speed around the centre [m/s]
};

/// The Gresho vortex. With s = distance from the axis / radius, the speed around the axis is speed (s; 2 - s; 0), and
/// (p - p0) / (rho0 speed²) = (s²/2; s²/2 + 4 (ln s + 1 - s); 4 ln 2 - 2), for s < 1; s < 2; larger s.
///
/// The slope of the speed jumps at s = 1 and s = 2. Where the grid repeats, the values are those of the nearest image.
/// Source: P. M. Gresho & S. T. Chan, Int. J. Numer. Methods Fluids 11 (1990) 621; for gas, R. Liska & B. Wendroff,
/// SIAM J. Sci. Comput. 25 (2003) 995, section 4.
class GreshoVortex : public GasReference {
 public:
  /// Throws std::invalid_argument if a setting is out of range, or if two images overlap.
  explicit GreshoVortex(const GreshoProblem& problem);

  GasState at(const Vec3& x, double t) const override;
  /// Uses piecewiseMean, split at s = 1 and s = 2; accurate to 1e-10 of the speed in boxes no wider than half the
  /// radius.
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;

 private:
  GreshoProblem problem_;
};

}  // namespace tushar::reference
