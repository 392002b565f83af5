#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

#include "components/euler/curved_gas.hpp"
#include "components/euler/real_gas.hpp"
#include "core/base/limiters.hpp"
#include "core/base/vec.hpp"

namespace tushar::euler {

/// The state of a cell in D dimensions, as numbers that loops over rows keep in registers. Primitive: density [kg/m³],
/// velocity along each axis [m/s], pressure [Pa]. Conserved, and fluxes: density, momentum, total energy per volume.
/// For K > 1 gases (mixture.hpp), followed by the mass of each gas per volume of the cell [kg/m³] and its volume
/// fraction; the density is then the sum of the masses. Loops over several cells at a time have Lanes as numbers.
template <int D, int K = 1, class Number = double>
using State = std::array<Number, D + 2 + (K > 1 ? 2 * K : 0)>;

/// Indices of the components of a State: density, component `axis` of velocity or momentum, pressure or total energy.
inline constexpr std::size_t kDensity = 0;
constexpr std::size_t kVelocity(int axis) { return axis + 1; }
template <int D>
inline constexpr std::size_t kPressure = D + 1;
/// Indices of the mass and the volume fraction of gas k in a State.
template <int D>
constexpr std::size_t kMass(int k) {
  return D + 2 + k;
}
template <int D, int K>
constexpr std::size_t kShare(int k) {
  return D + 2 + K + k;
}

/// A stiffened gas: p = (gamma - 1) rho e - gamma p_inf. With p_inf = 0, it is an ideal gas.
///
/// With P = p + p_inf, all waves are those of an ideal gas with pressure P. Source: F. H. Harlow & A. A. Amsden, Fluid
/// Dynamics, LANL report LA-4700 (1971). Numbers are double or Lanes.
struct StiffenedGas {
  double gamma = 1.4;    ///< ratio of specific heats, greater than 1
  double pInfinity = 0;  ///< p_inf [Pa]

  /// Squared speed of sound, c² [m²/s²] = gamma (p + p_inf) / rho.
  auto soundSpeedSquared(auto density, auto pressure) const { return gamma * (pressure + pInfinity) / density; }
  /// Internal energy per volume [J/m³] = (p + gamma p_inf) / (gamma - 1).
  auto energyOf(auto, auto pressure) const { return (pressure + gamma * pInfinity) * (1 / (gamma - 1)); }
  /// Pressure [Pa] at an internal energy per volume [J/m³].
  auto pressure(auto, auto internalEnergyPerVolume) const {
    return (gamma - 1) * internalEnergyPerVolume - gamma * pInfinity;
  }
  /// The last component of a state, which represents heat: the pressure.
  auto last(auto density, auto internalEnergyPerVolume) const { return pressure(density, internalEnergyPerVolume); }
  static auto pressureOf(auto, auto pressure) { return pressure; }
  double shockSlope() const { return 0.5 * (gamma + 1); }
  /// p + p_inf [Pa]; it is greater than 0 in possible states.
  auto heat(auto, auto pressure) const { return pressure + pInfinity; }
};

/// A gas: a stiffened gas, or a gas with its own law, that is, another equation of state.
struct Gas {
  using Law = std::variant<CurvedGas, Water, RealGas>;

  double gamma = 1.4;                        ///< ratio of specific heats, greater than 1
  double pInfinity = 0;                      ///< p_inf [Pa]
  double specificHeat = 0;                   ///< c_v [J/(kg K)]; 0: the temperature is unknown
  int material = 0;                          ///< index of the gas in the scene, for boundary conditions
  std::shared_ptr<const Law> law = nullptr;  ///< the gas's own law; null for a stiffened gas
  /// Weight per volume of the gas around [N/m³], by which the pressures that sides prescribe rise; see pressureAt.
  Vec3 weight = Vec3::Zero();
  /// Gravity [m/s²] and a force per volume [N/m³], under which the pressure rises beyond sides where it continues; 0
  /// with implicit steps, which find the pressure at such sides themselves.
  Vec3 gravity = Vec3::Zero(), push = Vec3::Zero();
  bool sticks = false;  ///< whether it is viscous, so that it has the velocity of a wall at the wall

  /// Calls `use` with the gas as a StiffenedGas, or with its own law, so that loops branch on the law only once, before
  /// they start.
  template <class Use>
  decltype(auto) withLaw(Use&& use) const {
    if (!law) return use(StiffenedGas{gamma, pInfinity});
    return std::visit(use, *law);
  }

  // Several of the following functions take the density and the last component of a primitive state. The last component
  // is the pressure, except in gases whose pressure depends only on the density; there, it is the heat per volume.

  /// Squared speed of sound, c² [m²/s²].
  double soundSpeedSquared(double density, double last) const {
    return withLaw([&](const auto& of) { return of.soundSpeedSquared(density, last); });
  }
  /// Internal energy per volume [J/m³].
  double energyOf(double density, double last) const {
    return withLaw([&](const auto& of) { return of.energyOf(density, last); });
  }
  /// Pressure [Pa].
  double pressureOf(double density, double last) const {
    return withLaw([&](const auto& of) { return of.pressureOf(density, last); });
  }
  /// A quantity that is greater than 0 in possible states: p + p_inf, the heat, or a number with the same sign.
  double heat(double density, double last) const {
    return withLaw([&](const auto& of) { return of.heat(density, last); });
  }
  /// Pressure [Pa] at a density and an internal energy per volume [J/m³].
  double pressure(double density, double internalEnergyPerVolume) const {
    return withLaw([&](const auto& of) { return of.pressure(density, internalEnergyPerVolume); });
  }
  /// The last component of the state with a given density and internal energy per volume [J/m³].
  double last(double density, double internalEnergyPerVolume) const {
    return withLaw([&](const auto& of) { return of.last(density, internalEnergyPerVolume); });
  }

  /// The gas constant R = (gamma - 1) c_v [J/(kg K)] in p + p_inf = rho R T.
  double gasConstant() const { return (gamma - 1) * specificHeat; }
  /// The last component of the state with a given density and temperature [K].
  double lastAt(double density, double temperature) const {
    if (!law) return gasConstant() * density * temperature - pInfinity;
    return std::visit([&](const auto& of) { return of.lastAt(density, temperature); }, *law);
  }
  /// Density [kg/m³] at a given pressure [Pa] and temperature [K].
  double densityAt(double pressure, double temperature) const {
    if (!law) return (pressure + pInfinity) / (gasConstant() * temperature);
    return std::visit([&](const auto& of) { return of.densityAt(pressure, temperature); }, *law);
  }
  /// Temperature [K] at a given density and internal energy per volume [J/m³]; if the gas has no law of its own, from
  /// c_v T = e - p_inf / rho.
  double temperature(double density, double internalEnergyPerVolume) const {
    if (!law) return (internalEnergyPerVolume - pInfinity) / (density * specificHeat);
    return std::visit([&](const auto& of) { return of.temperature(density, internalEnergyPerVolume); }, *law);
  }
  /// The smallest and the largest internal energy that the gas can have at a density [J/kg].
  std::pair<double, double> energyLimits(double density) const {
    return std::visit(
        [&](const auto& of) {
          return std::pair(of.leastEnergy(density) / density, of.greatestEnergy(density) / density);
        },
        *law);
  }
  /// p / (rho u²) behind a strong shock that accelerates gas at rest to the speed u: (gamma + 1) / 2.
  double shockSlope() const {
    return withLaw([](const auto& of) { return of.shockSlope(); });
  }
  /// Whether the pressure depends only on the density.
  bool isBarotropic() const {
    return law && std::visit([](const auto& of) { return of.isBarotropic(); }, *law);
  }
};

/// The law of a gas, if it is of the type Law.
template <class Law>
Law lawOf(const Gas& gas) {
  if constexpr (std::is_same_v<Law, StiffenedGas>)
    return {gas.gamma, gas.pInfinity};
  else
    return std::get<Law>(*gas.law);
}

/// The number of gases that a law describes.
template <class G>
inline constexpr int kGases = 1;
/// The law that applies in a state; for a single gas, the same in all states.
template <int D, class G, class Number>
const G& lawIn(const G& gas, const std::array<Number, D + 2>&) {
  return gas;  // NOLINT(bugprone-return-const-ref-from-parameter): callers keep the gas
}

/// The squared speed |v|² of a primitive state.
template <int D, class Number, std::size_t N>
[[gnu::always_inline]] inline Number speedSquared(const std::array<Number, N>& w) {
  Number sum = w[kVelocity(0)] * w[kVelocity(0)];
  for (int k = 1; k < D; ++k) sum += w[kVelocity(k)] * w[kVelocity(k)];
  return sum;
}

/// Computes rho, rho v, E from rho, v and the last component; G is Gas, one of its laws, or the law of a mixture.
template <int D, class G, class Number, std::size_t N>
[[gnu::always_inline]] inline std::array<Number, N> conserved(const G& gas, const std::array<Number, N>& w) {
  std::array<Number, N> u;
  u[kDensity] = w[kDensity];
  for (int k = 0; k < D; ++k) u[kVelocity(k)] = w[kDensity] * w[kVelocity(k)];
  u[kPressure<D>] = lawIn<D>(gas, w).energyOf(w[kDensity], w[kPressure<D>]) + 0.5 * w[kDensity] * speedSquared<D>(w);
  for (std::size_t k = D + 2; k < N; ++k) u[k] = w[k];
  return u;
}

/// Computes rho, v and the last component from rho, rho v, E.
template <int D, class G, class Number, std::size_t N>
[[gnu::always_inline]] inline std::array<Number, N> primitive(const G& gas, const std::array<Number, N>& u) {
  std::array<Number, N> w;
  w[kDensity] = u[kDensity];
  const Number inverse = 1.0 / u[kDensity];
  for (int k = 0; k < D; ++k) w[kVelocity(k)] = u[kVelocity(k)] * inverse;
  w[kPressure<D>] = lawIn<D>(gas, u).last(u[kDensity], u[kPressure<D>] - 0.5 * u[kDensity] * speedSquared<D>(w));
  for (std::size_t k = D + 2; k < N; ++k) w[k] = u[k];
  return w;
}

}  // namespace tushar::euler
