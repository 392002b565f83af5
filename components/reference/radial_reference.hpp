#pragma once

#include "components/reference/gas_reference.hpp"

namespace tushar::reference {

/// The state of a gas at a distance from a centre; the gas flows along the radius.
struct RadialState {
  double density = 0;   ///< density [kg/m^3]
  double velocity = 0;  ///< outward velocity [m/s]
  double pressure = 0;  ///< pressure [Pa]
  double energy = 0;    ///< internal energy per mass [J/kg]
};

/// A gas with one shock, whose state depends only on the distance from its centre, which is a plane, a line or a point.
class RadialReference : public GasReference {
 public:
  GasState at(const Vec3& x, double t) const final;
  /// Uses piecewiseMean with one piece on each side of the shock.
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;

  /// The distance of the shock from the centre [m].
  virtual double shockRadius(double t) const = 0;
  /// The state at a distance `r` >= 0 from the centre [m].  Throws std::invalid_argument if t < 0.
  virtual RadialState atRadius(double r, double t) const = 0;

 protected:
  /// `round` is 1 along the axes in which the distance is measured, and 0 along the others. Throws
  /// std::invalid_argument for other values, or if all are 0.
  RadialReference(const Vec3& centre, const Vec3& round);

  /// The number of axes in which the distance is measured: 1, 2 or 3.
  int dimension() const { return static_cast<int>(round_.sum()); }

 private:
  Vec3 centre_, round_;
};

/// Throws std::invalid_argument if `problem` cannot have the given density, `value`, pressure [Pa] or gamma. `amount`
/// is the name of `value`, such as the energy of a blast.
void requireRadialFlow(const char* problem, double density, const char* amount, double value, double pressure,
                       double gamma);

}  // namespace tushar::reference
