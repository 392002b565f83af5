#pragma once

#include <array>
#include <vector>

#include "core/core.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `controlVolFluxes`: writes the mass of a gas in boxes of cells, and the mass flow through the sides of these boxes,
/// over time. Each box has a file, `<label>.dat` in the archive, where Uintah writes it. A line has the time [s], the
/// mass [kg], the net inflow along x, y and z [kg/s], and the mass flow through the sides x- x+ y- y+ z- z+ [kg/s],
/// which is positive in the direction of the axis.
simulation::AnalysisKind controlVolFluxesKind();

/// The mass in a box [kg] and the mass flow through its sides [kg/s], with the index 2 * axis + side.
struct BoxFlow {
  Sum mass;
  std::array<Sum, 6> through;

  void merge(const BoxFlow& other);
  std::vector<double> values() const;
};

/// Adds the contribution of a patch to a box of cells. The flux through a side is the density of the upwind cell times
/// the mean velocity of the cells on both sides. At the end of the grid, the density is that of the cell inside, and
/// the velocity is the one prescribed on the side or the part of it, if there is one; at a symmetry plane the flux is
/// 0. Density and velocity need one layer of ghosts.
template <int D>
void addBoxFlow(const Patch& patch, const Box& box, int material, CellView<const double> density,
                CellView<const Vec<D>> velocity, BoxFlow& flow);

}  // namespace tushar::analysis
