#pragma once

namespace tushar::reference {

/// A stiffened gas: p = (gamma - 1) rho e - gamma p_inf. With p_inf = 0, it is an ideal gas.
struct GasLaw {
  double gamma = 1.4;    ///< ratio of specific heats
  double stiffness = 0;  ///< stiffness p_inf [Pa]
};

/// One side of a Riemann problem. It is vacuum if density and pressure are 0, and a cold gas if only the pressure is 0.
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

/// The self-similar solution of a Riemann problem of one or two gases, made by solveRiemann.
///
/// Values are exact to round-off of the input: about 1e-14, relative to the larger of the velocity and the speed of
/// sound. Source: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., chapter 4.
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

  /// The state at x/t = `xi` [m/s], which may be infinite. At a discontinuity, it is the state to its right. In vacuum,
  /// density and pressure are 0, and the velocity is that of the nearer front.
  RiemannState sample(double xi) const;

  /// Whether there is a vacuum between the two waves.
  bool hasVacuum() const;
};

/// Solves the Riemann problem of two gases exactly. If both sides have the same gas, there may be vacuum and cold gas.
///
/// A stiffened gas has the waves of an ideal gas with the pressure p + p_inf. p* is found to round-off by Newton's
/// method on Toro (4.5), within a bracket and with bisection where Newton's method fails. Two rarefactions of one gas
/// use the closed form (4.46). For vacuum, see section 4.6.
///
/// Throws std::invalid_argument if gamma <= 1, a value is not finite, a density, pressure or stiffness is negative, a
/// vacuum has a pressure, both sides are vacuum, or there is or forms a vacuum with two different gases.
RiemannSolution solveRiemann(const RiemannState& left, const RiemannState& right, const GasLaw& leftGas,
                             const GasLaw& rightGas);
/// Solves the Riemann problem with the same ideal gas on both sides.
RiemannSolution solveRiemann(const RiemannState& left, const RiemannState& right, double gamma);

}  // namespace tushar::reference
