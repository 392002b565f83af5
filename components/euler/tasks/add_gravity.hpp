#pragma once

#include "components/euler/labels.hpp"

namespace tushar::euler {

/// Adds rho g dt to the momentum and g . (m + m') / 2 dt to the energy, m and m' the momentum before and after: the
/// kinetic energy changes by the work of gravity [m/s²], the internal energy does not.
template <int D>
void addGravity(const Patch& patch, const Vec3& gravity, CellView<const double> density, double dt,
                CellView<Vec<D>> momentum, CellView<double> totalEnergy) {
  const Vec<D> g = patch.level().template reduce<D>(gravity);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const Vec<D> half = 0.5 * dt * density[cell] * g;
    totalEnergy[cell] += dt * g.dot(momentum[cell] + half);
    momentum[cell] += 2 * half;
  });
}

}  // namespace tushar::euler
