#pragma once

#include <optional>

#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// Computes the displacement of particles since the start: u_p += x'_p - x_p.
template <int D>
void addDisplacement(const Patch&, const Material&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> newX,
                     ParticleView<const Vec<D>> displacement, ParticleView<Vec<D>> newDisplacement) {
  for (int p = 0; p < x.owned(); ++p) newDisplacement[p] = displacement[p] + (newX[p] - x[p]);
}

/// Computes the true positions of particles: x_p or, in a grid that moves with them, where p.x does not change, x_p +
/// u_p.
template <int D>
void findDeformedPosition(const Patch&, const Material&, ParticleView<const Vec<D>> x,
                          const std::optional<ParticleView<const Vec<D>>>& displacement, ParticleView<Vec<D>> where) {
  for (int p = 0; p < x.owned(); ++p) where[p] = displacement ? Vec<D>(x[p] + (*displacement)[p]) : x[p];
}

}  // namespace tushar::mpm::solid
