#pragma once

#include "components/euler/gas.hpp"

namespace tushar::mpmice {

/// The pressure behind the shock that a moving wall drives into a gas of any law, where the velocity jumps by
/// `closing`: e - e_0 = (p + p_0) / 2 (v_0 - v), (p - p_0) (v_0 - v) = closing². If the pressure depends only on the
/// density, the second equation suffices. Solved for x = v_0 - v, where e = e_0 + p_0 x + closing² / 2, by secants of
/// sqrt((p - p_0) x), which is almost proportional to x, to 2e-15 rho (c + closing)²; by bisection if it is not.
/// Weak shocks, in which the volumes differ too little for that, have the pressure of an ideal gas with this speed of
/// sound: the error is of the order of rho closing², below 1e-12 rho c².
inline double shockPressure(const euler::Gas& gas, double density, double last, double closing) {
  const double before = gas.pressureOf(density, last), volume = 1 / density;
  const double c2 = gas.soundSpeedSquared(density, last);
  const double b = 0.5 * gas.shockSlope() * closing, speed = b + std::sqrt(b * b + c2);  // of the shock
  if (closing * closing < 1e-12 * c2) return before + density * closing * speed;
  const double energy = gas.energyOf(density, last) * volume + 0.5 * closing * closing;
  const bool isBarotropic = gas.isBarotropic();
  const auto excess = [&](double x) {  // of the jump of the velocity
    const double rho = 1 / (volume - x);
    const double of = isBarotropic ? gas.pressureOf(rho, 1) : gas.pressure(rho, rho * (energy + before * x));
    if (!(of > before) && !isBarotropic && !(gas.heat(rho, of) > 0)) return closing;  // denser than the gas can be
    return std::sqrt(std::max(0.0, (of - before) * x)) - closing;
  };
  double least = 0, most = volume, x = std::min(closing * volume / speed, 0.999 * volume);
  double found = excess(x), slope = closing / x;
  for (int k = 0; k < 100 && std::abs(found) > 2e-15 * (std::sqrt(c2) + closing); ++k) {
    (found < 0 ? least : most) = x;
    double next = x - found / slope;
    if (k >= 8 || !(next > least) || !(next < most)) next = 0.5 * (least + most);
    if (next <= least || next >= most) break;
    const double there = excess(next);
    if ((there - found) / (next - x) > 0) slope = (there - found) / (next - x);
    x = next;
    found = there;
  }
  return before + closing * closing / x;
}

/// The greatest number of steps of fanPressure.
inline constexpr int mostFanSteps = 32;

/// The number of steps with which errors of fanPressure are round-off, if it is not too large: in each, the velocity
/// and the speed of sound together change by less than .002 c.
inline int fanSteps(const euler::Gas& gas, double density, double last, double speed) {
  const double c = std::sqrt(gas.soundSpeedSquared(density, last));
  const double rho = density * (1 - speed / c), of = gas.isBarotropic() ? last : last - density * c * speed;
  if (!(rho > 0) || !(gas.heat(rho, of) > 0)) return mostFanSteps;
  const double steps = (speed + std::abs(std::sqrt(gas.soundSpeedSquared(rho, of)) - c)) / (0.002 * c);
  return steps < mostFanSteps ? static_cast<int>(steps) + 1 : mostFanSteps;
}

/// The pressure in the fan behind a wall that recedes at `speed` [m/s]: dp = -rho c du, drho = -rho / c du, integrated
/// by the fourth-order Runge-Kutta method; 0 if no gas is left.
inline double fanPressure(const euler::Gas& gas, double density, double last, double speed, int steps) {
  const bool isBarotropic = gas.isBarotropic();
  struct Rate {
    double density, last;
  };
  const auto rate = [&](double rho, double of) {
    if (!(rho > 0) || !(gas.heat(rho, of) > 0)) return Rate{std::nan(""), 0};
    const double c = std::sqrt(gas.soundSpeedSquared(rho, of));
    return Rate{-rho / c, isBarotropic ? 0 : -rho * c};
  };
  const double du = speed / steps;
  double rho = density, of = last;
  for (int k = 0; k < steps; ++k) {
    const Rate a = rate(rho, of), b = rate(rho + 0.5 * du * a.density, of + 0.5 * du * a.last);
    const Rate c = rate(rho + 0.5 * du * b.density, of + 0.5 * du * b.last);
    const Rate d = rate(rho + du * c.density, of + du * c.last);
    rho += du / 6 * (a.density + 2 * b.density + 2 * c.density + d.density);
    of += du / 6 * (a.last + 2 * b.last + 2 * c.last + d.last);
    if (!(rho > 0) || !(gas.heat(rho, of) > 0)) return 0;
  }
  return gas.pressureOf(rho, of);
}

/// Pressure [Pa] of a gas on a wall that approaches it at the speed `closing` [m/s]; a negative speed means that the
/// wall recedes. The pressure is that behind a shock if the wall approaches, and that behind a fan if it recedes; where
/// no gas is left, p + p_inf = 0. The gas is given by its density and the last component of its primitive state.
/// Source: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., section 4.3, with the speed
/// of the wall given.
inline double wallPressure(const euler::Gas& gas, double density, double last, double closing) {
  if (closing == 0) return gas.pressureOf(density, last);
  if (gas.law && closing > 0) return shockPressure(gas, density, last, closing);
  if (gas.law) return fanPressure(gas, density, last, -closing, fanSteps(gas, density, last, -closing));
  const double pressure = last, stiff = pressure + gas.pInfinity, c2 = gas.gamma * stiff / density;
  if (closing > 0) {
    const double b = 0.25 * (gas.gamma + 1) * closing;
    return pressure + density * closing * (b + std::sqrt(b * b + c2));
  }
  const double base = 1 + 0.5 * (gas.gamma - 1) * closing / std::sqrt(c2);
  if (!(base > 0)) return -gas.pInfinity;
  return stiff * std::pow(base, 2 * gas.gamma / (gas.gamma - 1)) - gas.pInfinity;
}

}  // namespace tushar::mpmice
