#pragma once

#include <functional>

#include "components/reference/gas_reference.hpp"

namespace tushar::reference {

/// An isentropic wave that runs towards larger x into gas at rest.
struct SimpleWaveProblem {
  /// Initial velocity u(x, 0) along `axis` [m/s]; smooth and defined for every x [m].
  std::function<double(double)> velocity;
  double density = 1;     ///< rho0 of the gas at rest [kg/m^3]
  double soundSpeed = 1;  ///< c0 of the gas at rest [m/s]
  double gamma = 1.4;     ///< ratio of specific heats
  /// Start of the interval that is searched for the steepest descent of u + c [m].
  double lower = 0;
  double upper = 1;  ///< end of that interval [m]
  int axis = 0;      ///< axis of the wave: 0, 1 or 2
};

/// The exact solution of a simple wave, until it breaks.
///
/// u and c = c0 + (gamma-1)/2 u stay constant along the straight characteristics dx/dt = u + c;
/// rho = rho0 (c/c0)^(2/(gamma-1)),  p = rho0 c0^2/gamma (c/c0)^(2 gamma/(gamma-1)).
/// Source: G. B. Whitham, Linear and Nonlinear Waves, section 6.8.
class SimpleWave : public GasReference {
 public:
  /// Throws std::invalid_argument if a setting is out of range, or if the profile within [lower, upper] is not finite
  /// or so negative that c <= 0.
  explicit SimpleWave(SimpleWaveProblem problem);

  /// Throws std::invalid_argument if t < 0, and std::domain_error, which names the breaking time, if the wave has
  /// broken.
  GasState at(const Vec3& x, double t) const override;
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;

  bool holdsAt(double t) const override { return t >= 0 && t < breakingTime_; }

  /// First time [s] at which characteristics meet, -1 / min d(u + c)/dx over [lower, upper]; infinite if they never do.
  /// The slope is computed by differences; it is accurate to about 1e-8 for profiles wider than 1/200 of the interval.
  double breakingTime() const { return breakingTime_; }

  /// The position x along the wave's axis [m] at which the characteristic through (x, t) started.
  double foot(double x, double t) const;

 private:
  double signalSpeed(double start) const;
  double signalSlope(double start) const;
  void checkProfile() const;
  GasState stateOf(double u) const;
  double findBreakingTime() const;
  double steepestFall() const;

  SimpleWaveProblem problem_;
  double differenceStep_ = 0;
  double breakingTime_ = 0;
};

}  // namespace tushar::reference
