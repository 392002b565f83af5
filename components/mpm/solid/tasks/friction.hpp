#pragma once

#include "components/mpm/solid/contact/friction.hpp"
#include "components/mpm/solid/tasks/interpolate_particles_to_grid.hpp"

namespace tushar::mpm::solid {

/// What friction needs of the surface of a body (see BodySurface) at every node of the patch.
template <class Shape, int D = Shape::dimension>
void computeSurface(const Patch& patch, const Material& material, const Vec3& commonSize, ParticleView<const Vec<D>> x,
                    OptionalView<const Vec<D>> size, ParticleView<const double> mass,
                    ParticleView<const Matrix3> deformation, OptionalView<const double> volume,
                    OptionalView<const Matrix3> stress, NodeView<Vec<D>> massGradient, NodeView<Vec<D>> position,
                    NodeView<Matrix3> stressMoment) {
  massGradient.fill(Vec<D>::Zero());
  position.fill(Vec<D>::Zero());
  stressMoment.fill(Matrix3::Zero());
  const Box& box = position.box();
  const Extents<Shape> extents(patch.level(), commonSize, size, deformation);
  const Sources<Shape> from{extents,          x, x, valuesOf(mass), valuesOf(volume), nullptr, valuesOf(stress),
                            valuesOf(deformation), nullptr};
  forEachStencil<Shape>(patch, x.cells(), x, extents, [&](int p, const auto& stencil) {
    Matrix3 moment;
    forceMoments(material, from, p, 1, &moment);
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
      if (!box.contains(node)) return;
      massGradient[node] += mass[p] * gradient;
      position[node] += s * mass[p] * x[p];
      stressMoment[node] += s * moment;
    });
  });
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (patch.isAtBoundary(d, side) && patch.level().isSymmetry(d, side, material.index))
        forEach<D>(patch.faceNodes(d, side), [&](const Index<D>& node) { massGradient[node][d] = 0; });
}

/// Friction between materials that touch, on whatever velocity the records hold.
template <int D>
void applyFriction(const Patch& patch, const std::vector<Material>&, const std::vector<Contact>& contacts, double dt,
                   const std::vector<NodeView<const Vec<D>>>& massGradient,
                   const std::vector<NodeView<const Vec<D>>>& position,
                   const std::vector<NodeView<const Matrix3>>& stress, const Records& records) {
  for (const Contact& contact : contacts)
    if (contact.type == Contact::Type::friction) rub<D>(patch, contact, dt, records, {massGradient, position, stress});
}

}  // namespace tushar::mpm::solid
