#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/contact/friction.hpp"
#include "components/mpm/solid/explicit/keeps.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/stress_source.hpp"

namespace tushar::mpm::solid {

/// Views of the variables that computeSurface reads and writes.
template <int D>
struct SurfaceSources {
  ParticleView<const Vec<D>> x;
  Sizes<D> size;
  ParticleView<const double> mass;
  ParticleView<const Matrix3> deformation;
  OptionalView<const Matrix3> particleStress;  ///< stress, if it is not a function of F alone
  NodeView<Vec<D>> massGradient, position;
  NodeView<Matrix3> stress;
  NodeView<double> volume;

  static SurfaceSources from(auto& take, int reach, const Keeps& keeps) {
    return {.x = take(requiresOld(p::x<D>, reach)),
            .size = Sizes<D>::from(take, keeps.sizes, reach),
            .mass = take(requiresOld(p::mass, reach)),
            .deformation = take(requiresOld(p::deformationMeasure, reach)),
            .particleStress = take(when(keeps.stress, requiresOld(p::stress, reach))),
            .massGradient = take(computes(g::massGradient<D>)),
            .position = take(computes(g::massPosition<D>)),
            .stress = take(computes(g::surfaceStress)),
            .volume = take(computes(g::surfaceVolume))};
  }
};

/// Extends a body beyond symmetry planes: no gradient points through the plane, and the volume counts twice.
template <int D>
void mirrorSurface(const Patch& patch, const Material& material, NodeView<Vec<D>> massGradient,
                   NodeView<double> volume) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (patch.isAtBoundary(d, side) && patch.level().isSymmetry(d, side, material.index))
        forEach<D>(patch.faceNodes(d, side), [&](const Index<D>& node) {
          massGradient[node][d] = 0;
          volume[node] *= 2;
        });
}

/// Computes the surface of a body for friction (see ContactSurface) at every node of the patch. In axisymmetric scenes,
/// the gradient is that of the density, as in Uintah: the mass grows with the radius, so that its gradient would tilt
/// the normal.
template <class Shape, int D = Shape::dimension>
void computeSurface(const Patch& patch, const Material& material, const Vec3& commonSize, const SurfaceSources<D>& u) {
  u.massGradient.fill(Vec<D>::Zero());
  u.position.fill(Vec<D>::Zero());
  u.stress.fill(Matrix3::Zero());
  u.volume.fill(0.0);
  const Box& box = u.position.box();
  const Extents<Shape> extents(patch.level(), commonSize, u.size, u.deformation);
  const double density = material.undeformedDensity();
  forEachStencil<Shape>(patch, u.x.cells(), u.x, extents, [&](int p, const auto& stencil) {
    const double mass = u.mass[p], v = mass / density * u.deformation[p].determinant();
    const double weight = Shape::axisymmetric ? mass / v : mass;
    Matrix3 sigma = Matrix3::Zero();
    if (u.particleStress)
      sigma = (*u.particleStress)[p];
    else
      cauchyStress(material, &u.deformation[p], 1, &sigma);
    forEachNodeWithin(stencil, box, [&](const Index<D>& node, double s, const Vec<D>& gradient) {
      u.massGradient[node] += weight * gradient;
      u.position[node] += s * mass * u.x[p];
      u.stress[node] += s * sigma;
      u.volume[node] += s * v;
    });
  });
  mirrorSurface<D>(patch, material, u.massGradient, u.volume);
}

/// Applies friction between materials in contact, and computes its heat [J] if the scene needs it.
template <int D>
void exchangeByFriction(const Patch& patch, const std::vector<Material>&, const std::vector<Contact>& contacts,
                        Moment moment, double dt, const Surfaces<D>& surfaces, const Records& records,
                        const FrictionHeats& heat) {
  for (const auto& ofMaterial : heat)
    if (ofMaterial) ofMaterial->fill(0.0);
  for (const Contact& contact : contacts)
    if (contact.type == Contact::Type::friction && (contact.actsTwice || moment == Moment::end))
      applyFriction<D>(patch, contact, dt, records, surfaces, heat);
}

}  // namespace tushar::mpm::solid
