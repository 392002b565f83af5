#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "components/euler/settings.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpmice {

/// The largest |v_x| + |v_y| + |v_z| + c of a gas at the start [m/s]; infinite if formulas give the initial state, or
/// if it is impossible.
inline double fastestInGas(const euler::Settings& gas) {
  double most = 0;
  for (const euler::GasObject& object : gas.objects) {
    const bool isKnown = object.density.isConstant() && object.velocity.isConstant() && object.temperature &&
                         object.temperature->isConstant();
    if (!isKnown) return std::numeric_limits<double>::infinity();
    const double density = object.density(Vec3::Zero());
    const double last = gas.gas.lastAt(density, (*object.temperature)(Vec3::Zero()));
    const double squared = gas.gas.soundSpeedSquared(density, last);
    if (!(squared > 0)) return std::numeric_limits<double>::infinity();
    most = std::max(most, object.velocity(Vec3::Zero()).lpNorm<1>() + std::sqrt(squared));
  }
  return most;
}

/// The speed of the fastest wave in bodies at the start [m/s].
inline double fastestInBodies(const std::vector<mpm::solid::Material>& materials) {
  double most = 0;
  for (const mpm::solid::Material& material : materials)
    for (const mpm::solid::Body& body : material.bodies)
      most = std::max(most, material.model->initialWaveSpeed(material.density, body.temperature(Vec3::Zero())));
  return most;
}

/// How many times as fast as the gas and its sound the waves in bodies must be for the gas to take explicit steps
/// although the scene has an <ImplicitSolver>. Even in three dimensions, the explicit steps of the gas are then at
/// least three times as long as those of the bodies, which are always explicit.
inline constexpr double muchFaster = 10;

/// Whether waves in bodies limit the steps so strongly that the gas needs no implicit steps.
inline bool areBodiesMuchFaster(const std::vector<mpm::solid::Material>& materials, const euler::Settings& gas) {
  const double bodies = fastestInBodies(materials);
  return std::isfinite(bodies) && bodies >= muchFaster * fastestInGas(gas);
}

}  // namespace tushar::mpmice
