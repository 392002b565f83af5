#pragma once

#include "components/euler/fluxes.hpp"
#include "components/mpmice/free_space.hpp"

namespace tushar::mpmice {

/// The flux per area along `Axis` of an ideal gas through a face behind which there is no gas, from the exact solution
/// at x/t = 0: the gas expands into the vacuum in a fan. `gas` is rho, v, p; `side` is 1 if the vacuum is above the
/// face, otherwise -1.
template <int D, int Axis>
euler::State<D> fluxIntoVacuum(const euler::State<D>& gas, double gamma, int side) {
  const std::size_t normal = euler::kVelocity(Axis);
  const reference::RiemannState from{gas[euler::kDensity], side * gas[normal], gas[euler::kPressure<D>]};
  const reference::RiemannState at = reference::solveRiemann(from, {}, gamma).sample(0);
  euler::FaceState<D> face{gas, 0};
  face.w[euler::kDensity] = at.density;
  face.w[normal] = side * at.velocity;
  face.w[euler::kPressure<D>] = at.pressure;
  face.energy = at.pressure / (gamma - 1) + 0.5 * at.density * euler::speedSquared<D>(face.w);
  return euler::fluxOf<D, Axis, 1, double>(face);
}

/// Sets the fluxes through the lower faces of the cells of `faces` that have gas on one side only, as if these faces
/// were completely open. `w` contains the gas of the cells.
template <int D, int Axis>
void flowIntoVacuum(double gamma, const FreeSpace<D>& space, const NearBodies<D>& near, const Box& faces,
                    euler::Rows<D>& w, euler::Rows<D>& flux) {
  near.forEachActingIn(faces, [&](const Index<D>& above) {
    const Index<D> below = above - Index<D>::unit(Axis);
    if (!space.isInGrid(above, Axis)) return;
    if (space.isEmpty(above) == space.isEmpty(below) || !(space.aperture(above, Axis, 0) > 0)) return;
    const int side = space.isEmpty(above) ? 1 : -1;
    euler::store<D>(flux.at(above), 0,
                    fluxIntoVacuum<D, Axis>(euler::load<D>(w.at(side > 0 ? below : above), 0), gamma, side));
  });
}

}  // namespace tushar::mpmice
