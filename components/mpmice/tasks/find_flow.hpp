#pragma once

#include "components/ice/tracers/tracers.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpmice/labels.hpp"
#include "components/mpmice/settings.hpp"

namespace tushar::mpmice {

/// The gas after a step, and the velocity with which tracers move.
template <int D>
struct FlowOfGas {
  CellView<const double> free, density;
  CellView<const Vec<D>> momentum;
  CellView<Vec<D>> flow;

  static FlowOfGas from(auto& take) {
    return {.free = take(requiresNew(c::freeVolume)),
            .density = take(requiresNew(c::density)),
            .momentum = take(requiresNew(c::momentum<D>)),
            .flow = take(computes(ice::c::flow<D>))};
  }
};

/// A body after a step; its particles are still in the cells of before.
template <int D>
struct MovingBody {
  ParticleView<const Vec<D>> velocity;
  ParticleView<const double> mass;

  /// `reads` is readsNew for the masses of new particles, or readsOld for those at the start of a step.
  static MovingBody from(auto& take, auto reads) {
    return {.velocity = take(requiresNew(p::velocity<D>)), .mass = take(reads(p::mass, 0))};
  }
};

/// Finds the velocity with which tracers move: that of the gas in a cell or, where bodies leave it only a narrow hole,
/// the mean velocity of their particles, weighted by mass. So tracers in bodies move with these. It is 0 in a vacuum.
template <int D>
void findFlowAround(const Patch& patch, const std::vector<mpm::solid::Material>&, const FlowOfGas<D>& gas,
                    const std::vector<MovingBody<D>>& bodies) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const bool hasGas = gas.free[cell] >= leastFreeVolume && gas.density[cell] > 0;
    gas.flow[cell] = hasGas ? Vec<D>(gas.momentum[cell] / gas.density[cell]) : Vec<D>(Vec<D>::Zero());
    if (hasGas && gas.free[cell] >= narrowFreeVolume) return;
    double mass = 0;
    Vec<D> momentum = Vec<D>::Zero();
    for (const MovingBody<D>& body : bodies)
      for (const int p : body.mass.in(cell)) {
        mass += body.mass[p];
        momentum += body.mass[p] * body.velocity[p];
      }
    if (mass > 0) gas.flow[cell] = momentum / mass;
  });
}

}  // namespace tushar::mpmice
