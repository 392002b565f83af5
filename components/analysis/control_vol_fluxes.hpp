#pragma once

#include <array>
#include <vector>

#include "core/core.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `controlVolFluxes`: writes the mass of a gas in boxes of cells over time, and the mass flow through their sides, one
/// file per box: `<label>.dat` in the archive, where Uintah writes them. A line has the time [s], the mass [kg], the
/// inflow minus the outflow along x, y and z, and the flux through each side, x- x+ y- y+ z- z+, along the axis [kg/s].
simulation::AnalysisKind controlVolFluxesKind();

/// The mass in a box, and the flux through each side: 2 * axis + side, along x, y and z.
struct BoxFlow {
  Sum mass;
  std::array<Sum, 6> through;

  void merge(const BoxFlow& other);
  std::vector<double> values() const;
};

/// Adds a patch's share of a box of cells. The flux through a side is the density of the upwind cell times the mean
/// velocity of the two cells. At the end of the grid, the density is that of the gas inside; the flux is 0 at symmetry
/// planes, and uses the prescribed velocity if the side has one. Density and velocity need one layer of ghosts.
template <int D>
void addBoxFlow(const Patch& patch, const Box& box, int material, CellView<const double> density,
                CellView<const Vec<D>> velocity, BoxFlow& flow);

}  // namespace tushar::analysis
