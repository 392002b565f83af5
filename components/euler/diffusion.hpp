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
  double greatest(const Gas& gas, double density) const {
    const double heat = conductivity > 0 ? conductivity / gas.specificHeat : 0;
    return std::max(4.0 / 3 * viscosity, heat) / density;
  }
};

}  // namespace tushar::euler
