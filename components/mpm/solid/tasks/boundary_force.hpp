#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "core/grid/nodes_of_sides.hpp"

namespace tushar::mpm::solid {

/// Measures the force of a body on a side of the grid, including its inner sides, - sum_i f_i over the nodes of the
/// side, and the area of the side that the body covers, 2 sum_i V_i / h. showForce computes f_i and V_i. Sides normal
/// to axes that the grid does not use have no nodes.
template <int D>
void measureBoundary(const Patch& patch, const Material&, int face, NodeView<const Vec<D>> force,
                     NodeView<const double> volume, VectorSum& total, Sum& area) {
  for (int d = 0; d < D; ++d) {
    const int side = face % 2;
    if (patch.level().axis(d) != face / 2) continue;
    grid::forEachBoxOnSide(patch, d, side, [&](const Box& nodes) {
      forEach<D>(nodes, [&](const Index<D>& node) {
        if (!isOwned<D>(patch, node)) return;
        total.add(-patch.level().expandDirection<D>(force[node]));
        area.add(2 * volume[node] * patch.level().inverseSpacing(d));
      });
    });
  }
}

/// Measures force and area on a side normal to an axis that the grid does not use; the stress of every particle acts on
/// this side.
inline void measureThinBoundary(const Patch& patch, const Material&, int face, ParticleView<const double> volume,
                                ParticleView<const Matrix3> stress, VectorSum& total, Sum& area) {
  const double width = patch.level().cellWidth(face / 2), sign = face % 2 == 0 ? -1.0 : 1.0;
  if (width <= 0) return;
  const int count = volume.owned();
  const std::array<Sum*, 3> sums{&total.x, &total.y, &total.z};
  for (int axis = 0; axis < 3; ++axis)
    WideSum(*sums[axis]).addAll(count, [&](int p) { return sign * volume[p] / width * stress[p](axis, face / 2); });
  WideSum(area).addAll(count, [&](int p) { return volume[p] / width; });
}

/// Measures forces and areas on all six sides of the scene; `volume` and `stress` read those of particles.
template <int D, class Volume, class Stress>
void scheduleBoundaryForces(TaskList& tasks, const std::vector<Material>& materials, const std::array<bool, 3>& isThin,
                            Volume volume, Stress stress) {
  for (int face = 0; face < 6; ++face) {
    if (isThin[face / 2])
      tasks.perMaterial("mpm::measureThinBoundary", measureThinBoundary, materials, with(face), volume, stress,
                        computes(total::onFaces[face].force), computes(total::onFaces[face].area));
    else
      tasks.perMaterial("mpm::measureBoundary", measureBoundary<D>, materials, with(face),
                        requiresNew(g::internalForce<D>), requiresNew(g::volume), computes(total::onFaces[face].force),
                        computes(total::onFaces[face].area));
  }
}

}  // namespace tushar::mpm::solid
