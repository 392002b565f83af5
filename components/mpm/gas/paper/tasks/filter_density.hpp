#pragma once

#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/mirrored.hpp"
#include "components/mpm/labels.hpp"

namespace tushar::mpm::gas::paper {

/// Mean density of the particles of each cell [kg/m³]; 0 where there is none.
template <int D>
void averageDensity(const Patch& patch, const Gas&, ParticleView<const double> density, CellView<double> mean) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const auto sum = sumFromBothEnds<double>(density.in(cell), [&](int p, double& part) { part += density[p]; });
    mean[cell] = sum / std::max(density.in(cell).size(), 1);
  });
}

/// (18) of Tran, Kim & Berzins in its density form: where the mean density of a cell is an extremum along an axis,
/// (r_{c-1} - r_c)(r_{c+1} - r_c) > 0, every particle of the cell gets (r_{c-1} - 2 r_c + r_{c+1}) / 3 more, so that
/// the mean becomes that of the three cells. All cells at once; cells at the rim of the grid and next to empty ones
/// stay. An extremum that is as sharp along k axes becomes the mean of its 2k + 1 cells, so that it is never overshot;
/// one that is sharp along one axis only, and mere round-off along the others, is treated as in one dimension.
template <int D>
void filterDensity(const Patch& patch, const Gas&, CellView<const double> mean, ParticleView<double> density) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double excess = 0, size = 0, sharpest = 0;
    for (int d = 0; d < D; ++d) {
      const Index<D> below = cell - Index<D>::unit(d), above = cell + Index<D>::unit(d);
      if (!mean.box().contains(below) || !mean.box().contains(above)) continue;
      const double left = mean[below], here = mean[cell], right = mean[above];
      if (left == 0 || here == 0 || right == 0 || !((left - here) * (right - here) > 0)) continue;
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
