#pragma once

#include "components/mpm/solid/contact/friction.hpp"
#include "components/mpm/solid/explicit/tasks/interpolate_particles_to_grid.hpp"

namespace tushar::mpm::solid {

/// What friction needs of the surface of a body (see Surfaces) at every node of the patch. Where axisymmetric, the
/// gradient is that of the density, as in Uintah: mass grows with the radius, and would tilt the normal.
template <class Shape, int D = Shape::dimension>
void computeSurface(const Patch& patch, const Material& material, const Vec3& commonSize, ParticleView<const Vec<D>> x,
                    OptionalView<const Vec<D>> size, ParticleView<const double> mass,
                    ParticleView<const Matrix3> deformation, OptionalView<const Matrix3> particleStress,
                    NodeView<Vec<D>> massGradient, NodeView<Vec<D>> position, NodeView<Matrix3> stress,
                    NodeView<double> volume) {
  massGradient.fill(Vec<D>::Zero());
  position.fill(Vec<D>::Zero());
  stress.fill(Matrix3::Zero());
  volume.fill(0.0);
  const Box& box = position.box();
  const Extents<Shape> extents(patch.level(), commonSize, size, deformation);
  forEachStencil<Shape>(patch, x.cells(), x, extents, [&](int p, const auto& stencil) {
    const double j = deformation[p].determinant(), v = mass[p] / material.density * j;
    const double weight = Shape::axisymmetric ? mass[p] / v : mass[p];
    Matrix3 sigma = Matrix3::Zero();
    if (particleStress) {
      sigma = (*particleStress)[p];
    } else {
      material.model->kirchhoffStress(&deformation[p], 1, &sigma);
      sigma /= j;
    }
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
      if (!box.contains(node)) return;
      massGradient[node] += weight * gradient;
      position[node] += s * mass[p] * x[p];
      stress[node] += s * sigma;
      volume[node] += s * v;
    });
  });
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (patch.isAtBoundary(d, side) && patch.level().isSymmetry(d, side, material.index))
        forEach<D>(patch.faceNodes(d, side), [&](const Index<D>& node) {
          massGradient[node][d] = 0;
          volume[node] *= 2;
        });
}

/// Friction between materials that touch.
template <int D>
void applyFriction(const Patch& patch, const std::vector<Material>&, const std::vector<Contact>& contacts,
                   Moment moment, double dt, const std::vector<NodeView<const Vec<D>>>& massGradient,
                   const std::vector<NodeView<const Vec<D>>>& position,
                   const std::vector<NodeView<const Matrix3>>& stress,
                   const std::vector<NodeView<const double>>& volume, const Records& records) {
  for (const Contact& contact : contacts)
    if (contact.type == Contact::Type::friction && (contact.actsTwice || moment == Moment::end))
      rub<D>(patch, contact, dt, records, {massGradient, position, stress, volume}, {});
}

/// The same at the end of a step, with the heat that it makes, J.
template <int D>
void applyHeatingFriction(const Patch& patch, const std::vector<Material>&, const std::vector<Contact>& contacts,
                          double dt, const std::vector<NodeView<const Vec<D>>>& massGradient,
                          const std::vector<NodeView<const Vec<D>>>& position,
                          const std::vector<NodeView<const Matrix3>>& stress,
                          const std::vector<NodeView<const double>>& volume, const Records& records,
                          const std::vector<NodeView<double>>& heat) {
  for (NodeView<double> ofMaterial : heat) ofMaterial.fill(0.0);
  for (const Contact& contact : contacts)
    if (contact.type == Contact::Type::friction)
      rub<D>(patch, contact, dt, records, {massGradient, position, stress, volume}, heat);
}

}  // namespace tushar::mpm::solid
