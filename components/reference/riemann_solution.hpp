#pragma once

namespace tushar::reference {

/// A stiffened gas, p = (gamma - 1) rho e - gamma stiffness; with stiffness 0 an ideal gas.
struct GasLaw {
  double gamma = 1.4;    ///< ratio of specific heats
  double stiffness = 0;  ///< stiffness p_inf [Pa]
};

/// One side of a Riemann problem.  density = pressure = 0 is vacuum; pressure = 0 alone is a cold gas.
struct RiemannState {
  double density = 0;   ///< density [kg/m^3]
  double velocity = 0;  ///< velocity along the axis of the problem [m/s]
  double pressure = 0;  ///< pressure [Pa]
};

enum class WaveKind { shock, rarefaction };

/// The wave that runs into the gas of one side.
struct RiemannWave {
  WaveKind kind = WaveKind::rarefaction;
  double head = 0;  ///< speed of its edge towards the undisturbed gas [m/s]
  double tail = 0;  ///< speed of its other edge [m/s]; equals `head` for a shock; at the edge of vacuum, the front
};

/// The self-similar solution of a Riemann problem of one gas or two.
///
/// Source: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., chapter 4.
/// Made by solveRiemann.  Values are exact to round-off of the input: about 1e-14, relative to the larger of the
/// flow's velocity and sound speed.
struct RiemannSolution {
  RiemannState left;   ///< left state, as given
  RiemannState right;  ///< right state, as given
  GasLaw leftGas, rightGas;
  double starPressure = 0;      ///< p* [Pa]; 0 if there is vacuum between the waves
  double starVelocity = 0;      ///< u*, the speed of the contact [m/s]; the mean speed of the two fronts around vacuum
  double starDensityLeft = 0;   ///< rho*L [kg/m^3]
  double starDensityRight = 0;  ///< rho*R [kg/m^3]
  RiemannWave leftWave;
  RiemannWave rightWave;

  /// The state at x/t = `xi` [m/s], which may be infinite.  At a discontinuity, the state to its right.
  /// In vacuum density and pressure are 0 and the velocity is that of the nearer front.
  RiemannState sample(double xi) const;

  /// Whether there is, or forms, a vacuum between the two waves.
  bool hasVacuum() const;
};

/// Solves the Riemann problem of two gases exactly; if both sides have the same gas, also with vacuum and cold gas.
///
/// A stiffened gas has the waves of an ideal one of pressure p + p_inf.
/// p* is found by Newton's method on Toro (4.5) inside a bracket that falls back to bisection, to round-off; two
/// rarefactions of one gas use the closed form (4.46).  Vacuum: section 4.6.
/// Throws std::invalid_argument where gamma <= 1, a value is not finite, a density, pressure or stiffness is negative,
/// a pressure stands in vacuum, both sides are vacuum, or vacuum is beside or between two different gases.
RiemannSolution solveRiemann(const RiemannState& left, const RiemannState& right, const GasLaw& leftGas,
                             const GasLaw& rightGas);
/// Solves the Riemann problem with the same ideal gas on both sides.
RiemannSolution solveRiemann(const RiemannState& left, const RiemannState& right, double gamma);

}  // namespace tushar::reference
