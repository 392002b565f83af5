#pragma once

#include <cmath>
#include <vector>

#include "components/mpm/solid/explicit/tasks/update_particles.hpp"

namespace tushar::mpm::solid {

/// Whose change of volume the stress of a particle answers to.
enum class Volumes {
  own,    ///< its own
  shared  ///< that of all sound particles of its material in the cell
};

/// F_p = (J_c / det F_p)^(1/3) F_p with J_c = sum_p V0_p det F_p / sum_p V0_p over the sound particles of a cell
/// (masses go as V0), and tr L_p to match: their pressure no longer keeps the cell from being sheared or bent (Uintah's
/// DoPressureStabilization; as F-bar, de Souza Neto et al., Int. J. Solids Structures 33 (1996) 3277, for a cell). A
/// particle that is turned inside out is left as it is, and out of the sums.
template <class Shape>
void shareVolume(double dt, const data::ParticleRange& range, const ParticleStates<Shape>& s,
                 Matrix3* velocityGradient) {
  const auto bears = [&](int p) { return (!s.localized || !s.localized[p]) && s.deformation[p].determinant() > 0; };
  double start = 0, now = 0;
  for (const int p : range) {
    if (!bears(p)) continue;
    start += s.mass[p];
    now += s.mass[p] * s.deformation[p].determinant();
  }
  for (const int p : range) {
    if (!bears(p)) continue;
    const double cubed = now / start / s.deformation[p].determinant();
    const double stretch = std::cbrt(cubed);
    Matrix3& gradient = velocityGradient[p - range.first];
    s.deformation[p] *= stretch;
    gradient.diagonal().array() += std::log(stretch) / dt;
    if (s.volume) s.volume[p] *= cubed;
    if (s.velocityGradient) s.velocityGradient[p] = gradient;
  }
}

/// updateParticles of deformation gradients and stresses, where the particles of a cell share their change of volume.
/// Throws NumericalError where a wave has no speed.
template <class Shape, int D = Shape::dimension>
void updateCells(const Patch& patch, const Material& material, const Method& method, double dt,
                 NodeView<const NodeRecord> record, const ParticleStates<Shape>& s, CellView<double> stableTimeStep) {
  const Level& level = patch.level();
  const CrossingRate<D> none(level);
  std::vector<Matrix3> velocityGradient;
  stableTimeStep.fill(none.time());
  s.x.template forEachOccupied<D>(patch.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    velocityGradient.resize(static_cast<std::size_t>(range.size()));
    const CellFrame<D> frame(level, cell);
    for (const int p : range) {
      const typename Shape::Stencil stencil(frame, cell, s.x[p], s.extents[p]);
      const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(record, stencil));
      deformParticle<Shape>(level, method, dt, sums, material.erosion, s, p,
                            velocityGradient[static_cast<std::size_t>(p - range.first)]);
    }
    shareVolume<Shape>(dt, range, s, velocityGradient.data());
    CrossingRate<D> rate = none;
    for (int first = range.first; first < range.last; first += stressGroup)
      updateStress<Shape>(material, method, dt, s, velocityGradient.data() + (first - range.first), first,
                          std::min(stressGroup, range.last - first), rate);
    if (!rate.isKnown()) throw withoutWaveSpeed<Shape>(level, s, cell, range);
    stableTimeStep[cell] = rate.time();
  });
}

}  // namespace tushar::mpm::solid
