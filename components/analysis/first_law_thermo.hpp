#pragma once

#include "core/core.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `firstLawThermo`: the internal energy of gas and bodies over time, and the energy that leaves through sides of the
/// grid, in `1stLawThermo.dat` of the archive, where Uintah writes it. A line has the time [s], the internal energy of
/// the gas, mass times specific heat times temperature of bodies, both together [J], and the flow [W] through the sides
/// or their parts that the module names: of internal and kinetic energy and of the work of the pressure.
simulation::AnalysisKind firstLawThermoKind();

/// A side of the grid of which a flow is measured: the faces of these cells.
struct MeasuredSide {
  int axis = 0, side = 0;
  Box cells;
};

/// What addOutflow reads.
template <int D>
struct OutflowViews {
  CellView<const double> totalEnergy, pressure;
  CellView<const Vec<D>> velocity;
  std::optional<CellView<const double>> free;  ///< beside bodies, the share of the gas
};

/// Adds the flow of energy out through sides of the grid [W]: the normal velocity of the adjacent cells, or that given
/// at the side, times E + p.
template <int D>
void addOutflow(const Patch& patch, const std::vector<MeasuredSide>& sides, int material, const OutflowViews<D>& gas,
                Sum& outflow);

}  // namespace tushar::analysis
