#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace tushar::euler {

/// The state of a cell in D dimensions, as numbers that loops over rows keep in registers. Primitive: density [kg/m³],
/// velocity along each axis [m/s], pressure [Pa]. Conserved, and fluxes: density, momentum, total energy per volume.
template <int D>
using State = std::array<double, D + 2>;

/// Places in a State: density, component `axis` of velocity or momentum, pressure or total energy.
inline constexpr std::size_t kDensity = 0;
constexpr std::size_t kVelocity(int axis) { return axis + 1; }
template <int D>
inline constexpr std::size_t kPressure = D + 1;

/// A stiffened gas: p = (gamma - 1) rho e - gamma p_inf; with p_inf = 0 an ideal gas.
///
/// With P = p + p_inf all waves are those of an ideal gas of pressure P.
/// Source: F. H. Harlow & A. A. Amsden, Fluid Dynamics, LANL report LA-4700 (1971).
struct Gas {
  double gamma = 1.4;       ///< ratio of specific heats, above 1
  double pInfinity = 0;     ///< Pa
  double specificHeat = 0;  ///< c_v, J/(kg K); 0: no temperature is known
  int material = 0;         ///< its number in the scene, where sides of the grid have conditions for it

  /// c² [m²/s²] = gamma (p + p_inf) / rho.
  double soundSpeedSquared(double density, double pressure) const { return gamma * (pressure + pInfinity) / density; }
  /// Internal energy per volume [J/m³] = (p + gamma p_inf) / (gamma - 1).
  double internalEnergy(double pressure) const { return (pressure + gamma * pInfinity) * (1 / (gamma - 1)); }
  /// Pressure [Pa] of an internal energy per volume [J/m³].
  double pressure(double internalEnergyPerVolume) const {
    return (gamma - 1) * internalEnergyPerVolume - gamma * pInfinity;
  }
  /// R [J/(kg K)] = (gamma - 1) c_v of p + p_inf = rho R T.
  double gasConstant() const { return (gamma - 1) * specificHeat; }
};

/// |v|² of a primitive state.
template <int D>
double speedSquared(const State<D>& w) {
  double sum = 0;
  for (int k = 0; k < D; ++k) sum += w[kVelocity(k)] * w[kVelocity(k)];
  return sum;
}

/// rho, rho v, E of rho, v, p.
template <int D>
State<D> conserved(const Gas& gas, const State<D>& w) {
  State<D> u;
  u[kDensity] = w[kDensity];
  for (int k = 0; k < D; ++k) u[kVelocity(k)] = w[kDensity] * w[kVelocity(k)];
  u[kPressure<D>] = gas.internalEnergy(w[kPressure<D>]) + 0.5 * w[kDensity] * speedSquared<D>(w);
  return u;
}

/// rho, v, p of rho, rho v, E.
template <int D>
State<D> primitive(const Gas& gas, const State<D>& u) {
  State<D> w;
  const double inverse = 1 / u[kDensity];
  w[kDensity] = u[kDensity];
  for (int k = 0; k < D; ++k) w[kVelocity(k)] = u[kVelocity(k)] * inverse;
  w[kPressure<D>] = gas.pressure(u[kPressure<D>] - 0.5 * u[kDensity] * speedSquared<D>(w));
  return w;
}

}  // namespace tushar::euler
