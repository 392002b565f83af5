#pragma once

#include <algorithm>

#include "components/euler/gas.hpp"

namespace tushar::euler {

/// Coefficients of viscosity and heat conduction, uniform in space.
struct Diffusion {
  double viscosity = 0;     ///< viscosity mu [Pa s]
  double conductivity = 0;  ///< conductivity k [W/(m K)]

  bool acts() const { return viscosity > 0 || conductivity > 0; }
  /// The largest diffusivity [m²/s] in a gas of a given density [kg/m³]: the larger of 4/3 mu / rho, for sound waves,
  /// and k / (rho c_v), for heat.
  double greatest(const Gas& gas, double density) const { return greatest(gas.specificHeat, density); }
  /// The same, given the specific heat c_v [J/(kg K)].
  double greatest(double specificHeat, double density) const {
    const double heat = conductivity > 0 ? conductivity / specificHeat : 0;
    return std::max(4.0 / 3 * viscosity, heat) / density;
  }
  /// The coefficients with which both diffusivities, for sound waves and for heat, are equal to a given one [m²/s].
  static Diffusion ofDiffusivity(double diffusivity, double specificHeat, double density) {
    return {0.75 * density * diffusivity, specificHeat * density * diffusivity};
  }
  /// The smaller coefficients of two.
  Diffusion least(const Diffusion& other) const {
    return {std::min(viscosity, other.viscosity), std::min(conductivity, other.conductivity)};
  }
};

}  // namespace tushar::euler
