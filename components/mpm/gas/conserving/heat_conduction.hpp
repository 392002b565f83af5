#pragma once

#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/material.hpp"

namespace tushar::mpm::gas::conserving {

/// Computes artificial heat conduction where a shock compresses cells, to reduce wall heating. The heat flow through
/// the face between two cells along axis d is Q = C_h rho h max(0, -dv_d/dx_d) A (e_next - e), with the smaller density
/// and the smaller (more negative) derivative of the two cells. Adds dt Q / IE_c to the work of each cell; the flow
/// leaves one cell and enters the other. Source: W. F. Noh, J. Comput. Phys. 72 (1987) 78, section 3.
template <int D>
void conductHeat(const Patch& patch, const Gas&, double coefficient, CellView<const double> mass,
                 CellView<const double> internalEnergy, CellView<const Tensor<D>> gradient, double dt,
                 CellView<double> work) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!(internalEnergy[cell] > 0)) return;
    double power = 0;
    for (int d = 0; d < D; ++d) {
      double along = 0;
      for (const int side : {-1, 1}) {
        Index<D> next = cell;
        next[d] += side;
        if (!mass.box().contains(next) || !(mass[next] > 0)) continue;
        const double compression = std::max({0.0, -gradient[cell](d, d), -gradient[next](d, d)});
        along += coefficient * std::min(mass[cell], mass[next]) * compression *
                 (internalEnergy[next] / mass[next] - internalEnergy[cell] / mass[cell]);
      }
      power += along;
    }
    work[cell] += dt * power / internalEnergy[cell];
  });
}

}  // namespace tushar::mpm::gas::conserving
