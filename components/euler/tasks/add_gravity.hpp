#pragma once

#include "components/euler/labels.hpp"

namespace tushar::euler {

/// Changes a cell by gravity g [m/s²] in a step: adds rho g dt to the momentum, and g . (m + m') / 2 dt to the energy,
/// where m and m' are the momentum before and after. So the kinetic energy changes by the work of gravity, and the
/// internal energy stays constant.
template <int D>
void fall(const Vec<D>& gravity, double density, double dt, Vec<D>& momentum, double& totalEnergy) {
  const Vec<D> half = 0.5 * dt * density * gravity;
  totalEnergy += dt * gravity.dot(momentum + half);
  momentum += 2 * half;
}

/// Adds gravity to all cells.
template <int D>
void addGravity(const Patch& patch, const Vec3& gravity, CellView<const double> density, double dt,
                CellView<Vec<D>> momentum, CellView<double> totalEnergy) {
  const Vec<D> g = patch.level().template reduce<D>(gravity);
  forEach<D>(patch.cells(),
             [&](const Index<D>& cell) { fall<D>(g, density[cell], dt, momentum[cell], totalEnergy[cell]); });
}

/// Adds to all cells the effect of a uniform force per volume [N/m³] in a step.
template <int D>
void addForce(const Patch& patch, const Vec3& force, CellView<const double> density, double dt,
              CellView<Vec<D>> momentum, CellView<double> totalEnergy) {
  const Vec<D> push = patch.level().template reduce<D>(force);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    fall<D>(push / density[cell], density[cell], dt, momentum[cell], totalEnergy[cell]);
  });
}

}  // namespace tushar::euler
