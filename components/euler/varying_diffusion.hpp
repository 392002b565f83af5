#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "components/euler/diffusion.hpp"
#include "core/base/vec.hpp"

namespace tushar::euler {

/// A viscosity that rises with the temperature: mu = a T^(3/2) / (T + b).
/// Source: W. Sutherland, Phil. Mag. 36 (1893) 507.
struct Sutherland {
  double a = 0;  ///< a [Pa s / sqrt(K)]
  double b = 0;  ///< b [K]

  double viscosity(double temperature) const {
    return a * temperature * std::sqrt(std::max(temperature, 0.0)) / (temperature + b);
  }
};

/// A box in which the gas has a different viscosity, such as a layer in front of a side of the grid that absorbs waves.
struct SpongeLayer {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< lower corner and upper corner [m]
  double viscosity = 0;                             ///< viscosity [Pa s]

  bool contains(const Vec3& point) const {
    return (point.array() >= lower.array()).all() && (point.array() <= upper.array()).all();
  }
};

/// Viscosity and conductivity that vary in space or with the flow.
struct VaryingDiffusion {
  Diffusion uniform = {};                     ///< used where none of the following settings applies
  std::optional<Sutherland> sutherland = {};  ///< replaces the uniform viscosity
  std::vector<SpongeLayer> sponges =
      {};  ///< viscosity in boxes, which replaces both; where boxes overlap, the last one applies
  /// Smagorinsky's constant C for eddies: mu + rho (C Delta)² sqrt(2 S : S)
  double smagorinsky = 0;

  bool varies() const { return sutherland || !sponges.empty() || smagorinsky > 0; }
  /// The coefficients of the gas at a point [m] and a temperature [K], without eddies.
  Diffusion at(const Vec3& point, double temperature) const {
    Diffusion here = uniform;
    if (sutherland) here.viscosity = sutherland->viscosity(temperature);
    for (const SpongeLayer& sponge : sponges)
      if (sponge.contains(point)) here.viscosity = sponge.viscosity;
    return here;
  }
};

}  // namespace tushar::euler
