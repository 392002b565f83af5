#pragma once

#include "components/mpm/solid/transfer/stencil_groups.hpp"

namespace tushar::mpm::solid {

/// The values sum_i S_i v_i of a field at particles.
template <class Stencils>
Lanes fieldAt(const Stencils& stencils, const NodeView<const double>& field) {
  const auto values = nodeValues(stencils, field);
  Lanes sum = 0.0;
  stencils.forEachNode([&](std::size_t at, Lanes s, const auto&) { sum += s * values[at]; });
  return sum;
}

/// Views of the temperatures of particles within reach of shape functions.
template <int D>
struct ThermalParticles {
  Placed<D> placed;
  ParticleView<const double> mass, temperature;

  static ThermalParticles from(auto& take, int reach, KeptSizes keepsSizes) {
    return {.placed = Placed<D>::from(take, keepsSizes, reach, requiresOld(p::deformationMeasure, reach)),
            .mass = take(requiresOld(p::mass, reach)),
            .temperature = take(requiresOld(p::temperature, reach))};
  }
};

}  // namespace tushar::mpm::solid
