#pragma once

#include <vector>

#include "core/base/vec.hpp"

namespace tushar::reference {

/// The state of a gas at a point, or its mean over a box.
struct GasState {
  double density = 0;            ///< density [kg/m^3]
  Vec3 velocity = Vec3::Zero();  ///< velocity [m/s]
  double pressure = 0;           ///< pressure [Pa]
  double energy = 0;             ///< internal energy per mass [J/kg]
};

/// A solution of the gas equations with which the results of runs are compared.
class GasReference {
 public:
  virtual ~GasReference() = default;

  /// The fields at position `x` [m] and time `t` [s]. Throws std::invalid_argument if t < 0, and std::domain_error
  /// where the solution does not hold.
  virtual GasState at(const Vec3& x, double t) const = 0;

  /// Whether the solution has values at time `t` [s].
  virtual bool holdsAt(double t) const { return t >= 0; }

  /// Whether errors are to be measured at `x` [m] at time `t` [s].
  virtual bool covers(const Vec3&, double t) const { return holdsAt(t); }

  /// Mean of each field over the box [lower, upper] [m] at time `t` [s]; along an axis without extent, the box is a
  /// point. Each mean is one over volume; those of velocity and internal energy are not weighted by mass either.
  /// Gauss-Legendre with 8 points per axis, split at `breaks` and then halved until two halves agree with the whole to
  /// 1e-12 of the field's size; for velocities, the size is the larger of speed and speed of sound. Throws
  /// std::invalid_argument if upper < lower or t < 0.
  virtual GasState average(const Vec3& lower, const Vec3& upper, double t) const;

  /// Positions along `axis` [m], sorted, at which a field or its slope jumps at time `t` [s].
  virtual std::vector<double> breaks(int axis, double t) const;

 protected:
  /// The `average` of fields that vary only along `axis`; it needs no quadrature along the other axes.
  GasState averageAlong(int axis, const Vec3& lower, const Vec3& upper, double t) const;
};

}  // namespace tushar::reference
