#pragma once

#include <array>
#include <vector>

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::gas::paper {

/// `massProjection`: computes the difference between the nodal mass m_i and the integral of S_i rho, and the bound of
/// this difference: (19)-(23) of Tran, Kim & Berzins. In one dimension, for `gas_dynamics` with `volume_model`
/// cell_share.
///
/// rho(x) is taken to be piecewise linear between the particles, and constant beyond the last one before an empty cell:
/// so rho(x_p) = rho_p, as (19) requires, at any time and without an exact solution. E_m^i therefore excludes the error
/// of the particle densities themselves.
simulation::AnalysisKind massProjectionKind();

namespace g {
using namespace gas::g;
inline constexpr NodeLabel<double> massProjectionError{
    "g.massProjectionError", "kg",
    "E_m^i: integral of shape function times density, minus the mass gathered from particles"};
inline constexpr NodeLabel<double> massProjectionBound{"g.massProjectionBound", "kg", "bound of |E_m^i|"};
}  // namespace g

/// The label of the largest |E_m^i| divided by the volume of a cell, which is |E_m^i| / h in the paper.
inline constexpr ReductionLabel<Maximum> massProjectionError{
    "MassProjectionError", "kg/m^3", "largest error of the mass projection, divided by the cell volume"};
inline constexpr ReductionLabel<Maximum> massProjectionRatio{
    "MassProjectionRatio", "1", "largest ratio of the error of the mass projection to its bound"};

/// The position of a particle relative to a cell (0: lower face, 1: upper face), and its density.
struct PlacedDensity {
  double place;
  double density;  ///< density [kg/m³]
};

/// The discrepancy D_2 of the particles of a cell, sorted by position:
/// sqrt(1 / (12 N²) + 1/N sum_k (z_k - (2k-1)/(2N))²), (20) with z in [0,1]; Hickernell, Math. Comp. 67 (1998) 299.
double discrepancy(const std::vector<PlacedDensity>& particles);

/// The contribution of a cell to the errors of its lower and its upper node, divided by its volume [kg/m³].
struct CellProjection {
  std::array<double, 2> error{};  ///< error at each node, one bracket of (22)
  /// Bound at each node, one term of (23); |d(rho S_i)/dx| at xi is its root mean square over the cell.
  std::array<double, 2> bound{};
};

/// Computes the contribution of a cell with at least one particle; `particles` are sorted by position. `line` is the
/// density along the cell: piecewise linear between its points, from place 0 to place 1.
CellProjection projectCell(const std::vector<PlacedDensity>& particles, const std::vector<PlacedDensity>& line);

/// Computes E_m^i and its bound at the nodes [kg], and the largest ratios of |E_m^i| to the cell volume [kg/m³] and to
/// its bound. A node next to a cell without particles has neither: both are set to 0.
void measureMassProjection(const Patch& patch, const Gas& gas, ParticleView<const Vec<1>> x,
                           ParticleView<const double> density, NodeView<double> error, NodeView<double> bound,
                           Maximum& greatestError, Maximum& greatestRatio);

}  // namespace tushar::mpm::gas::paper
