#pragma once

#include "components/mpm/labels.hpp"

namespace tushar::mpm {

/// Variables of the conserving gas method alone.
namespace p {
inline constexpr ParticleLabel<double> length{"p.length", "m", "length of the interval that the particle fills"};
inline constexpr ParticleLabel<double> velocityGradient{"p.velocityGradient", "1/s", "slope of the velocity within"};
inline constexpr ParticleLabel<double> affineEnergy{"p.affineEnergy", "J/kg",
                                                    "kinetic energy per mass of the motion about the mean velocity"};
}  // namespace p

namespace c {
inline constexpr CellLabel<double> mass{"c.mass", "kg", "mass of the parts of particles in the cell"};
inline constexpr CellLabel<double> internalEnergy{"c.internalEnergy", "J", "internal energy of those parts"};
inline constexpr CellLabel<double> stress{"c.stress", "Pa", "pressure of the cell, artificial viscosity included"};
}  // namespace c

}  // namespace tushar::mpm
