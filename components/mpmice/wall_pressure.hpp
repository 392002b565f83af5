#pragma once

#include "components/euler/gas.hpp"

namespace tushar::mpmice {

/// Pressure [Pa] of a gas on a wall that it meets with the speed `closing` [m/s]: behind a shock where it closes in,
/// behind a fan where it draws back, 0 of p + p_inf where there is no gas left.
/// Source: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., section 4.3, with the wall's
/// speed given.
inline double wallPressure(const euler::Gas& gas, double density, double pressure, double closing) {
  if (closing == 0) return pressure;
  const double stiff = pressure + gas.pInfinity, c2 = gas.gamma * stiff / density;
  if (closing > 0) {
    const double b = 0.25 * (gas.gamma + 1) * closing;
    return pressure + density * closing * (b + std::sqrt(b * b + c2));
  }
  const double base = 1 + 0.5 * (gas.gamma - 1) * closing / std::sqrt(c2);
  if (!(base > 0)) return -gas.pInfinity;
  return stiff * std::pow(base, 2 * gas.gamma / (gas.gamma - 1)) - gas.pInfinity;
}

}  // namespace tushar::mpmice
