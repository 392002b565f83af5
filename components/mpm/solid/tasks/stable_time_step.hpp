#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// Time in which a wave of speed c in a material that moves with v crosses a cell, s; the least over x, y, z.
template <int D>
double crossingTime(const Level& level, double c, const Vec<D>& v) {
  double time = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (const double h = level.cellWidth(axis); h > 0) time = std::min(time, h / c);
  for (int d = 0; d < D; ++d) time = std::min(time, level.spacing(d) / (c + std::abs(v[d])));
  return time;
}

/// Of the state at the start, with the speed of a wave where the density is that of F.
template <int D>
void computeInitialTimeStep(const Patch& patch, const Material& material, ParticleView<const Vec<D>> velocity,
                            ParticleView<const double> temperature, ParticleView<const Matrix3> deformation,
                            CellView<double> stableTimeStep) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double least = std::numeric_limits<double>::infinity();
    for (const int p : velocity.in(cell)) {
      const double density = material.density / deformation[p].determinant();
      const double waveSpeed = material.model->initialWaveSpeed(density, temperature[p]);
      least = std::min(least, crossingTime<D>(patch.level(), waveSpeed, velocity[p]));
    }
    stableTimeStep[cell] = least;
  });
}

/// The least over all cells.
template <int D>
void computeStableTimeStep(const Patch& patch, const Material&, CellView<const double> stableTimeStep,
                           data::Minimum& dt) {
  double least = std::numeric_limits<double>::infinity();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { least = std::min(least, stableTimeStep[cell]); });
  dt.add(least, "wave speed");
}

}  // namespace tushar::mpm::solid
