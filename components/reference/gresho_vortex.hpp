#pragma once

#include "components/reference/moving_frame.hpp"

namespace tushar::reference {

/// A vortex of two rings in which the pressure balances the turning, carried along by a uniform flow.
struct GreshoProblem {
  double density = 1;   ///< everywhere, kg/m^3
  double pressure = 5;  ///< in the middle, Pa
  double gamma = 1.4;   ///< ratio of specific heats
  double speed = 1;     ///< the greatest around the centre, m/s
  double radius = 0.2;  ///< where that speed is reached, m; the gas beyond twice of it does not turn
  int axis = 2;         ///< 0, 1 or 2: what it turns around; it is the same all along it
  MovingFrame frame;    ///< its centre; the velocity is that of the flow
};

/// The Gresho vortex. With s = distance from the axis / radius the velocity around it is speed (s; 2 - s; 0) and
/// (p - p0) / (rho speed²) = (s²/2; s²/2 + 4 (ln s + 1 - s); 4 ln 2 - 2) where s < 1; s < 2; else.
///
/// Its speed jumps in slope at both radii. Where the grid repeats, the values are those of the nearest image.
/// Source: P. M. Gresho & S. T. Chan, Int. J. Numer. Methods Fluids 11 (1990) 621; for gas: R. Liska & B. Wendroff,
/// SIAM J. Sci. Comput. 25 (2003) 995, section 4.
class GreshoVortex : public GasReference {
 public:
  /// Throws std::invalid_argument where a setting is out of range, or two images overlap.
  explicit GreshoVortex(const GreshoProblem& problem);

  GasState at(const Vec3& x, double t) const override;
  /// By piecewiseMean, cut at the two radii: to 1e-10 of the speed in boxes no wider than half the radius.
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;

 private:
  GreshoProblem problem_;
};

}  // namespace tushar::reference
