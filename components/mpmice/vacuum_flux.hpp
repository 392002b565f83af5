#pragma once

#include "components/euler/fluxes.hpp"
#include "components/euler/mixture.hpp"
#include "components/mpmice/free_space.hpp"

namespace tushar::mpmice {

/// The flux per area along `Axis` of ideal gases through a face behind which there is no gas, from the exact solution
/// at x/t = 0: they expand into the vacuum in a fan. `gas` is rho, v, p and, for several gases, the mass and the volume
/// fraction of each; `side` is 1 if the vacuum is above the face, otherwise -1.
template <int D, int Axis, int K = 1>
euler::State<D, K> fluxIntoVacuum(const euler::State<D, K>& gas, double gamma, int side) {
  const std::size_t normal = euler::kVelocity(Axis);
  const reference::RiemannState from{gas[euler::kDensity], side * gas[normal], gas[euler::kPressure<D>]};
  const reference::RiemannState at = reference::solveRiemann(from, {}, gamma).sample(0);
  if (!(at.density > 0)) return {};
  euler::FaceState<D, K> face{gas, 0};
  face.w[euler::kDensity] = at.density;
  face.w[normal] = side * at.velocity;
  face.w[euler::kPressure<D>] = at.pressure;
  if constexpr (K > 1)
    for (int k = 0; k < K; ++k) face.w[euler::kMass<D>(k)] *= at.density / from.density;
  face.energy = at.pressure / (gamma - 1) + 0.5 * at.density * euler::speedSquared<D>(face.w);
  return euler::fluxOf<D, Axis, K, double>(face);
}

/// Sets the fluxes through the lower faces of the cells of `faces` that have gas on one side only, as if these faces
/// were completely open. `w` contains the gas of the cells.
template <int D, int Axis, class G, int K = euler::kGases<G>>
void flowIntoVacuum(const G& gas, const FreeSpace<D>& space, const NearBodies<D>& near, const Box& faces,
                    euler::Rows<D, K>& w, euler::Rows<D, K>& flux) {
  const auto gammaOf = [&]([[maybe_unused]] const euler::State<D, K>& state) {
    if constexpr (K > 1)
      return euler::lawIn<D>(gas, state).alike().gamma;
    else
      return gas.gamma;
  };
  near.forEachActingIn(faces, [&](const Index<D>& above) {
    const Index<D> below = above - Index<D>::unit(Axis);
    if (!space.isInGrid(above, Axis)) return;
    if (space.isEmpty(above) == space.isEmpty(below) || !(space.aperture(above, Axis, 0) > 0)) return;
    const int side = space.isEmpty(above) ? 1 : -1;
    const auto from = euler::load<D>(w.at(side > 0 ? below : above), 0);
    euler::store<D>(flux.at(above), 0, fluxIntoVacuum<D, Axis, K>(from, gammaOf(from), side));
  });
}

/// Replaces the volumes of several gases in cells without gas by what flows in along an axis, of which `flux` contains
/// the fluxes; for axes after the first, adds it. There, volume fractions of before the step mean nothing.
template <int D, int Axis, int K>
void addToVacuum(const FreeSpace<D>& space, const NearBodies<D>& near, const Box& block, double ratio,
                 euler::Rows<D, K>& flux, const std::vector<CellView<double>>& volumes) {
  near.forEachActingIn(block, [&](const Index<D>& cell) {
    if (!space.isVacuum(cell)) return;
    for (int k = 0; k < K; ++k) {
      const std::size_t share = euler::kShare<D, K>(k);
      const double in = ratio * (flux.number(cell, share) - flux.number(cell + Index<D>::unit(Axis), share));
      volumes[k][cell] = Axis == 0 ? in : volumes[k][cell] + in;
    }
  });
}

}  // namespace tushar::mpmice
