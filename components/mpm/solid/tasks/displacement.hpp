#pragma once

#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// The displacement of particles since the start: u_p += x'_p - x_p.
template <int D>
void addDisplacement(const Patch&, const Material&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> newX,
                     ParticleView<const Vec<D>> displacement, ParticleView<Vec<D>> newDisplacement) {
  for (int p = 0; p < x.owned(); ++p) newDisplacement[p] = displacement[p] + (newX[p] - x[p]);
}

}  // namespace tushar::mpm::solid
