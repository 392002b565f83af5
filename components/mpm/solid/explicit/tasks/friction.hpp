#pragma once

#include <Eigen/LU>

#include <vector>

#include "components/mpm/solid/contact/friction.hpp"
#include "components/mpm/solid/contact/meeting_bodies.hpp"
#include "components/mpm/solid/contact/present.hpp"
#include "components/mpm/solid/explicit/keeps.hpp"
#include "components/mpm/solid/transfer/cell_run.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/mirror_images.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"
#include "components/mpm/solid/transfer/stress_source.hpp"

namespace tushar::mpm::solid {

/// The variables of a material that computeSurface reads and writes.
template <int D>
struct SurfaceSources {
  ParticleView<const Vec<D>> x;
  Sizes<D> size;
  ParticleView<const double> mass;
  ParticleView<const Matrix3> deformation;
  OptionalView<const Matrix3> particleStress;  ///< stress, if it is not a function of F alone
  NodeView<SurfaceRecord> surface;

  static SurfaceSources from(auto& take, int reach, const Keeps& keeps) {
    return {.x = take(requiresOld(p::x<D>, reach)),
            .size = Sizes<D>::from(take, keeps.sizes, reach),
            .mass = take(requiresOld(p::mass, reach)),
            .deformation = take(requiresOld(p::deformationMeasure, reach)),
            .particleStress = take(when(keeps.stress, requiresOld(p::stress, reach))),
            .surface = take(computes(g::surfaceRecord))};
  }
};

/// Extends a body beyond symmetry planes: no gradient points through the plane, and the volume counts twice.
template <int D>
void mirrorSurface(const Patch& patch, const Material& material, NodeView<SurfaceRecord> surface);

/// The contribution of the mirror image of a particle to a node in front of symmetry planes: that of the particle to
/// the image of this node, `beyond`.
template <int D>
SurfaceShare<D> imageShare(const Level& level, const Index<D>& node, const Index<D>& beyond, const Vec<D>& signs,
                           Vec<D> x, double mass, double volume, double weight, Matrix3 sigma) {
  for (int d = 0; d < D; ++d) {
    if (signs[d] > 0) continue;
    x[d] = level.nodePosition(d, node[d]) + level.nodePosition(d, beyond[d]) - x[d];
    const int axis = sceneAxis<D>(level, d);
    sigma.row(axis) *= -1;
    sigma.col(axis) *= -1;
  }
  return {x, mass, volume, weight, sigma};
}

/// Adds the particles of a material around places where bodies meet. In axisymmetric scenes, the gradient is that of
/// the density, as in Uintah, because the mass grows with the radius and would tilt the normal.
template <class Shape, int D = Shape::dimension>
void addSurface(const Patch& patch, const Material& material, const Vec3& commonSize, const MeetingPlaces<D>& places,
                const SurfaceSources<D>& u) {
  const Box& box = u.surface.box();
  const Extents<Shape> extents(patch.level(), commonSize, u.size, u.deformation);
  const double density = material.undeformedDensity();
  const SymmetryPlanes<D> planes(patch.level(), material);
  const auto add = [&](int p, const Matrix3& sigma, const auto& stencil) {
    const double mass = u.mass[p], v = mass / density * u.deformation[p].determinant();
    const double weight = Shape::axisymmetric ? mass / v : mass;
    const SurfaceShare<D> share(u.x[p], mass, v, weight, sigma);
    forEachNodeWithin(stencil, box, [&](const Index<D>& node, double s, const Vec<D>& gradient) {
      share.addTo(u.surface[node], s, gradient);
    });
    if (!planes.any()) return;
    stencil.forEachNode([&](const Index<D>& beyond, double s, const Vec<D>& gradient) {
      planes.ifBeyond(beyond, [&](const Index<D>& node, const Vec<D>& signs) {
        if (box.contains(node))
          imageShare<D>(patch.level(), node, beyond, signs, u.x[p], mass, v, weight, sigma)
              .addTo(u.surface[node], s, gradient.cwiseProduct(signs));
      });
    });
  };
  CellRun<D> near;
  std::vector<Matrix3> stress;
  const auto addNear = [&] {
    if (near.count() == 0) return;
    stress.resize(std::max(stress.size(), static_cast<std::size_t>(near.count())));
    if (!u.particleStress) cauchyStress(material, &u.deformation[near.first()], near.count(), stress.data());
    const Matrix3* const sigma = u.particleStress ? &(*u.particleStress)[near.first()] : stress.data();
    near.forEachCell([&](const Index<D>& cell, const data::ParticleRange& range) {
      const CellFrame<D> frame(patch.level(), cell);
      for (const int p : range)
        add(p, sigma[p - near.first()], typename Shape::Stencil(frame, cell, u.x[p], extents[p]));
    });
    near.clear();
  };
  u.x.template forEachOccupied<D>(u.x.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    if (!places.areNear(cell, Shape::ghostNodes)) return;
    if (!near.takes(range)) addNear();
    near.add(cell, range);
  });
  addNear();
  mirrorSurface<D>(patch, material, u.surface);
}

/// The surfaces of bodies for friction, at the nodes of the patch where several bodies have mass; 0 at other nodes that
/// the body touches.
template <class Shape, int D = Shape::dimension>
void computeSurface(const Patch& patch, const std::vector<Material>& materials, const Vec3& commonSize,
                    const std::vector<NodeView<const NodeRecord>>& records, const std::vector<SurfaceSources<D>>& of) {
  const std::vector<std::size_t> present = presentIn(records);
  if (present.empty()) return;
  MeetingPlaces<D> places(of[present.front()].surface.box());
  for (const std::size_t m : present) places.add(touchedRows<D>(of[m].x, Shape::ghostNodes), records[m]);
  for (const std::size_t m : present) {
    const auto clear = [&surface = of[m].surface](const Index3& node) {
      surface.values()[surface.stored().offset(node)] = SurfaceRecord{};
    };
    const data::TouchedRows& rows = touchedRows<D>(of[m].x, Shape::ghostNodes);
    places.forEachIn(rows, true, clear);
    addSurface<Shape>(patch, materials[m], commonSize, places, of[m]);
    places.forEachIn(rows, false, clear);
  }
}

/// Applies friction between materials in contact, and computes its heat [J] if the scene needs it.
template <int D>
void exchangeByFriction(const Patch& patch, const std::vector<Material>& materials,
                        const std::vector<Contact>& contacts, Moment moment, int ghostNodes,
                        const std::vector<ParticleView<const Vec<D>>>& x, double dt, const Surfaces& surfaces,
                        const Records& records, const FrictionHeats& heat) {
  if (const auto present = presentIn(records); present.size() < records.size())
    return exchangeByFriction<D>(patch, materials, contactsAmong(contacts, present, records.size()), moment, ghostNodes,
                                 onlyOf(x, present), dt, onlyOf(surfaces, present), onlyOf(records, present),
                                 onlyOf(heat, present));
  RowsOfNodes rows;
  for (const auto& ofMaterial : x) rows.push_back(&touchedRows<D>(ofMaterial, ghostNodes));
  for (const auto& ofMaterial : heat)
    if (ofMaterial) ofMaterial->fill(0.0);
  const MeetingBodies<D> meeting(rows, records);
  for (const Contact& contact : contacts)
    if (contact.type == Contact::Type::friction && (contact.actsTwice || moment == Moment::end))
      applyFriction<D>(patch, contact, dt, meeting, records, surfaces, heat);
}

}  // namespace tushar::mpm::solid
