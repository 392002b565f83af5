#pragma once

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/problem.hpp"
#include "core/grid/nodes_of_sides.hpp"

namespace tushar::mpm::solid {

/// Measures the force of a body on a side of the grid, including its inner sides, - sum_i f_i over the nodes of the
/// side, and the area of the side that the body covers, 2 sum_i V_i / h. showForce computes f_i and V_i. Functions that
/// reach beyond the side give forces to nodes there, too: the side holds them, if it prescribes the velocity; a
/// symmetry plane holds their normal components twice, since the mirror image gives the nodes in front the opposite
/// forces. Sides normal to axes that the grid does not use have no nodes.
template <int D>
void measureBoundary(const Patch& patch, const Material& material, int face, NodeView<const Vec<D>> force,
                     NodeView<const double> volume, VectorSum& total, Sum& area) {
  const Level& level = patch.level();
  for (int d = 0; d < D; ++d) {
    const int side = face % 2;
    if (level.axis(d) != face / 2) continue;
    const bool isPlane = level.isSymmetry(d, side, material.index);
    const auto given = level.boundary(d, side, boundary::velocity, material.index);
    grid::forEachBoxBeyond(patch, d, side, [&](const Box& nodes, int) {
      if (!isPlane && !(given && given->isDirichlet())) return;
      forEach<D>(nodes.intersect(force.box()), [&](const Index<D>& node) {
        if (!isOwned<D>(patch, node)) return;
        Vec<D> held = force[node];
        if (isPlane) held = 2 * held[d] * Vec<D>::Unit(d);
        total.add(-level.expandDirection<D>(held));
      });
    });
    grid::forEachBoxOnSide(patch, d, side, [&](const Box& nodes) {
      forEach<D>(nodes, [&](const Index<D>& node) {
        if (!isOwned<D>(patch, node)) return;
        total.add(-level.expandDirection<D>(force[node]));
        area.add(2 * volume[node] * level.inverseSpacing(d));
      });
    });
  }
}

/// Measures force and area on a side normal to an axis that the grid does not use; the stress of every particle acts on
/// this side. With `radii`, in axisymmetric scenes, the sides z- and z+ are the planes through the axis that bound a
/// radian: a particle covers the area V / r of them.
template <int D>
void measureThinBoundary(const Patch& patch, const Material&, int face, ParticleView<const double> volume,
                         ParticleView<const Matrix3> stress, const std::optional<ParticleView<const double>>& viscosity,
                         const std::optional<ParticleView<const Vec<D>>>& radii, VectorSum& total, Sum& area) {
  const double width = patch.level().cellWidth(face / 2), sign = face % 2 == 0 ? -1.0 : 1.0;
  if (width <= 0) return;
  const auto areaOf = [&](int p) { return volume[p] / (radii ? (*radii)[p][0] : width); };
  const int count = volume.owned();
  const std::array<Sum*, 3> sums{&total.x, &total.y, &total.z};
  for (int axis = 0; axis < 3; ++axis)
    WideSum(*sums[axis]).addAll(count, [&](int p) {
      const double viscous = viscosity && axis == face / 2 ? (*viscosity)[p] : 0.0;
      return sign * areaOf(p) * (stress[p](axis, face / 2) - viscous);
    });
  WideSum(area).addAll(count, areaOf);
}

/// Measures forces and areas on all six sides of the scene; `volume` and `stress` read those of particles, `isViscous`
/// tells whether they have a viscous pressure.
template <int D, class Volume, class Stress>
void scheduleBoundaryForces(TaskList& tasks, const Problem& problem, Volume volume, Stress stress,
                            bool isViscous = false) {
  const std::vector<Material>& materials = problem.materials;
  for (int face = 0; face < 6; ++face) {
    if (problem.method.isThin[face / 2])
      tasks.perMaterial("mpm::measureThinBoundary", measureThinBoundary<D>, materials, with(face), volume, stress,
                        when(isViscous, requiresOld(p::viscosity)),
                        when(problem.start.axisymmetric && face / 2 == 2, requiresOld(p::x<D>)),
                        computes(total::onFaces[face].force), computes(total::onFaces[face].area));
    else
      tasks.perMaterial("mpm::measureBoundary", measureBoundary<D>, materials, with(face),
                        requiresNew(g::internalForce<D>), requiresNew(g::volume), computes(total::onFaces[face].force),
                        computes(total::onFaces[face].area));
  }
}

}  // namespace tushar::mpm::solid
