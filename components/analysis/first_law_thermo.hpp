#pragma once

#include "core/core.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `firstLawThermo`: writes the internal energy of gas and bodies, and the energy that leaves through sides of the
/// grid, over time. They are in `1stLawThermo.dat` in the archive, where Uintah writes it. A line has the time [s]; the
/// internal energy of the gas, that of the bodies (mass times specific heat times temperature), and their sum [J]; and
/// the energy flow [W] through the sides, or parts of sides, that the module names. This flow consists of internal
/// energy, kinetic energy and the work of the pressure.
simulation::AnalysisKind firstLawThermoKind();

/// A side of the grid through which the flow is measured: the faces of these cells.
struct MeasuredSide {
  int axis = 0, side = 0;
  Box cells;
};

/// The views that addOutflow reads.
template <int D>
struct OutflowViews {
  CellView<const double> totalEnergy, pressure;
  CellView<const Vec<D>> velocity;
  std::optional<CellView<const double>> free;  ///< volume fraction of the gas, if there are bodies
};

/// Adds the flow of energy out through sides of the grid [W]: the normal velocity of the adjacent cells, or that given
/// at the side, times E + p.
template <int D>
void addOutflow(const Patch& patch, const std::vector<MeasuredSide>& sides, int material, const OutflowViews<D>& gas,
                Sum& outflow);

}  // namespace tushar::analysis
