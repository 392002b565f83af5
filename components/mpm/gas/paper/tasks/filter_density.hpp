#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/mirror_symmetry.hpp"

namespace tushar::mpm::gas::paper {

/// Computes the mean density of the particles in each cell [kg/m³]; 0 in empty cells.
template <int D>
void averageDensity(const Patch& patch, const Gas&, ParticleView<const double> density, CellView<double> mean) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const auto sum = sumOverParticles<double>(density.in(cell), [&](int p, double& part) { part += density[p]; });
    mean[cell] = sum / std::max(density.in(cell).size(), 1);
  });
}

/// Whether the density of a cell is less than that of both its neighbours, or more, and not by round-off alone.
inline bool isExtremum(double left, double here, double right) {
  constexpr double rounding = 1e-12;
  return (left - here) * (right - here) > 0 &&
         std::min(std::abs(left - here), std::abs(right - here)) > rounding * here;
}

/// Applies (18) of Tran, Kim & Berzins to the density; nodal velocities are not filtered. Where the mean density r_c of
/// a cell is an extremum along an axis, (r_{c-1} - r_c)(r_{c+1} - r_c) > 0, the density of each of its particles
/// changes by (r_{c-1} - 2 r_c + r_{c+1}) / 3, so that r_c becomes the mean of the three cells.
///
/// All cells are filtered from the same unfiltered means, except those at the rim of the grid or next to an empty cell.
/// An extremum equally sharp along k axes becomes the mean of its 2k + 1 cells and never overshoots; one that is sharp
/// along one axis, and mere round-off along the others, is filtered as in one dimension. Cells whose densities differ
/// by round-off are equal, so that neither of them is an extremum: such as two cells that are mirror images.
template <int D>
void filterDensity(const Patch& patch, const Gas&, CellView<const double> mean, ParticleView<double> density) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double excess = 0, size = 0, sharpest = 0;
    for (int d = 0; d < D; ++d) {
      const Index<D> below = cell - Index<D>::unit(d), above = cell + Index<D>::unit(d);
      if (!mean.box().contains(below) || !mean.box().contains(above)) continue;
      const double left = mean[below], here = mean[cell], right = mean[above];
      if (left == 0 || here == 0 || right == 0 || !isExtremum(left, here, right)) continue;
      const double along = (left + right) - 2 * here;
      excess += along;
      size += std::abs(along);
      sharpest = std::max(sharpest, std::abs(along));
    }
    if (sharpest == 0) return;
    for (const int p : density.in(cell)) density[p] += excess / (1 + 2 * (size / sharpest));
  });
}

}  // namespace tushar::mpm::gas::paper
