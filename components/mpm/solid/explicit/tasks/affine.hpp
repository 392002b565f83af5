#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/boundary.hpp"
#include "components/mpm/solid/transfer/mirror_images.hpp"
#include "components/mpm/solid/transfer/placed.hpp"

namespace tushar::mpm::solid {

// The affine particle-in-cell method: a particle carries B_p = sum_i S_i v*_i (x_i - x_p)^T besides its velocity, so
// that velocities that are linear in space go to the grid and back unchanged, and angular momentum is conserved; Jiang,
// Schroeder, Selle, Teran & Stomakhin, ACM Trans. Graph. 34 (2015) 51. Velocities are those of PIC.

/// The factors S_i D^(-1) (x_i - x_p) along an axis [1/m], with D = sum_i S_i (x_i - x_p)^2; where D vanishes, the
/// factors are dS_i/dx, the limit for the tent function.
template <std::size_t N>
void setAffineFactors(const std::array<Quad, N>& s, int axis, double firstNode, double spacing, double x,
                      std::array<Quad, N>& factors) {
  std::array<double, N> away;
  double spread = 0;
  for (std::size_t k = 0; k < N; ++k) {
    away[k] = firstNode + static_cast<double>(k) * spacing - x;
    spread += s[k][axis] * away[k] * away[k];
  }
  if (spread > 1e-12 * spacing * spacing)
    for (std::size_t k = 0; k < N; ++k) factors[k][axis] = s[k][axis] * away[k] / spread;
}

/// Adds the affine velocities to the nodes: v_i += sum_p S_i m_p B_p D_p^(-1) (x_i - x_p) / m_i
template <class Shape, int D = Shape::dimension>
void addAffineVelocity(const Patch& patch, const Material& material, const Vec3& commonSize, const Placed<D>& particles,
                       ParticleView<const double> mass, ParticleView<const Matrix3> moment,
                       NodeView<NodeRecord> record) {
  const Level& level = patch.level();
  const SymmetryPlanes<D> planes(level, material);
  const auto& x = particles.x;
  forEachStencil<Shape>(patch, x.cells(), particles, commonSize, [&](int p, auto stencil) {
    for (int d = 0; d < D; ++d)
      setAffineFactors(stencil.s, d, level.nodePosition(d, stencil.first[d]), level.spacing(d), x[p][d], stencil.ds);
    stencil.forEachNode([&](const Index<D>& node, double, const Vec<D>& factors) {
      addVelocityAndImage<D>(planes, record, node, moment[p].topLeftCorner<D, D>() * factors, mass[p]);
    });
  });
  setSymmetry<D>(patch, material.index, touchedRows<D>(x, Shape::ghostNodes), record);
}

/// Computes B_p = sum_i S_i v*_i (x_i - x_p)^T [m^2/s].
template <class Shape, int D = Shape::dimension>
void updateAffineMoment(const Patch& patch, const Material&, const Vec3& commonSize, NodeView<const NodeRecord> record,
                        const Placed<D>& particles, ParticleView<Matrix3> moment) {
  const Level& level = patch.level();
  forEachStencil<Shape>(patch, patch.cells(), particles, commonSize, [&](int p, const auto& stencil) {
    moment[p].setZero();
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&) {
      Vec<D> away;
      for (int d = 0; d < D; ++d) away[d] = level.nodePosition(d, node[d]) - particles.x[p][d];
      moment[p].template topLeftCorner<D, D>() += s * lanes<D>(record[node], lane::velocity) * away.transpose();
    });
  });
}

/// Sets the initial B of each particle to 0.
inline void initializeAffineMoment(const Patch&, const Material&, ParticleView<const double> mass,
                                   ParticleView<Matrix3> moment) {
  for (int p = 0; p < mass.owned(); ++p) moment[p].setZero();
}

}  // namespace tushar::mpm::solid
