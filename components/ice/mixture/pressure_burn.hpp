#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/input/schema.hpp"

namespace tushar::ice {

/// JWL++: an explosive becomes gas at a rate that depends on the pressure, dF/dt = G p^b (1 - F), where F is the burned
/// fraction. Source: P. C. Souers & al., Propellants, Explosives,
/// Pyrotechnics 25 (2000) 54. As in Uintah, artificial viscosity is not part of p, and a step converts at most a fifth
/// of the density of the explosive.
struct PressureBurn {
  Location where;  ///< in the scene
  std::string from, to;
  double factor = 0;         ///< G [1/(s Pa^b)]
  double exponent = 0;       ///< b
  double density = 0;        ///< density of the explosive [kg/m³]
  double heat = 0;           ///< heat of the reaction [J/kg]
  double leastPressure = 0;  ///< pressure above which the explosive reacts [Pa]
  double leastShare = 0;     ///< volume fraction of the explosive above which it reacts

  bool actsAt(double pressure, double share) const { return pressure > leastPressure && share > leastShare; }
  /// The fraction of the explosive that is converted in a time [s] at a constant pressure [Pa].
  double converted(double pressure, double dt) const {
    return -std::expm1(-factor * std::pow(pressure, exponent) * dt);
  }
  /// The largest mass that is converted in a step [kg/m³].
  double mostPerStep() const { return 0.2 * density; }
};

/// A gas that reacts at a rate that depends on the pressure.
struct Reaction {
  std::size_t from = 0, to = 0;
  PressureBurn burn;
};

/// What reacts in a cell, per volume of the gas: the masses of the reactant and its product [kg/m³], and their volume
/// fractions.
struct Reactants {
  double from = 0, to = 0, share = 0;

  /// The fraction of the reactant that is converted in a time [s] at a pressure [Pa].
  double converted(const PressureBurn& burn, double pressure, double dt) const {
    if (!(from > 0) || !burn.actsAt(pressure, share)) return 0;
    return std::min(burn.converted(pressure, dt), burn.mostPerStep() / from);
  }
};

const input::Schema<PressureBurn>& pressureBurnSchema();

}  // namespace tushar::ice
