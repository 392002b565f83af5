#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/boundary.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// What a particle brings to the nodes.
template <class Shape>
struct Sources {
  static constexpr int D = Shape::dimension;

  Extents<Shape> extents;
  ParticleView<const Vec<D>> x, velocity;
  const double *mass, *volume, *viscosity;  ///< volume and viscosity null where there is none
  const Matrix3 *stress, *deformation;      ///< one of them; where both are null, there is no force
  const Vec<D>* externalForce;              ///< or null
};

/// V (sigma - q I) of up to stressGroup particles from `first` on.
template <class Shape>
void forceMoments(const Material& material, const Sources<Shape>& from, int first, int count, Matrix3* moments) {
  if (material.isRigid || (!from.stress && !from.deformation)) {
    std::fill_n(moments, count, Matrix3(Matrix3::Zero()));
    return;
  }
  if (from.stress)
    for (int k = 0; k < count; ++k) moments[k] = from.volume[first + k] * from.stress[first + k];
  else {
    material.model->kirchhoffStress(from.deformation + first, count, moments);
    const double inverseDensity = 1 / material.density;
    for (int k = 0; k < count; ++k) moments[k] *= from.mass[first + k] * inverseDensity;
  }
  if (!from.viscosity) return;
  for (int k = 0; k < count; ++k) {
    const double volume = from.volume
                              ? from.volume[first + k]
                              : from.mass[first + k] / material.density * from.deformation[first + k].determinant();
    moments[k].diagonal().array() -= volume * from.viscosity[first + k];
  }
}

/// Adds particles of a cell to the nodes around, those of the view's box where `isWithin`, else all: m v and m with
/// S_i, -V sigma with its gradient.
template <class Shape, bool isWithin, int D = Shape::dimension>
void scatterGroup(const Level& level, const Material& material, const Sources<Shape>& from, const Index<D>& cell,
                  int first, int count, const NodeView<NodeRecord>& record) {
  std::array<Matrix3, stressGroup> moments;
  forceMoments(material, from, first, count, moments.data());
  const CellFrame<D> frame(level, cell);
  for (int k = 0; k < count; ++k) {
    const int p = first + k;
    const Matrix3& moment = moments[static_cast<std::size_t>(k)];
    const typename Shape::Stencil stencil(frame, cell, from.x[p], from.extents[p]);
    const Vec<D> force = from.externalForce ? from.externalForce[p] : Vec<D>(Vec<D>::Zero());
    const NodeRecord value{quadOf<D>(from.mass[p] * from.velocity[p], from.mass[p]),
                           quadOf<D>(force, from.volume ? from.volume[p] : 0.0)};
    std::array<Quad, D> slope;
    for (int d = 0; d < D; ++d) {
      Vec<D> traction;
      for (int i = 0; i < D; ++i) traction[i] = -moment(sceneAxis<D>(level, i), sceneAxis<D>(level, d));
      slope[static_cast<std::size_t>(d)] = quadOf<D>(traction, 0);
    }
    const Quad hoop{-moment(2, 2), 0, 0, 0};
    if constexpr (isWithin)
      scatterWithin(stencil, record.box(), windowFrom(record, stencil.first), value, slope, hoop);
    else
      scatter(stencil, windowOf<NodeRecord>(record, stencil), value, slope, hoop);
  }
}

/// Whether a particle touches a node of a box, or nearly.
template <class Shape, int D = Shape::dimension>
bool touches(const CellFrame<D>& frame, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent,
             const Box& nodes) {
  constexpr double rounding = 1e-6;
  const Vec<D> xi = frame.coordinates(x), support = Shape::support(extent);
  for (int d = 0; d < D; ++d) {
    const double at = cell[d] + xi[d], reach = support[d] + rounding;
    if (at + reach <= nodes.lower[d] || at - reach >= nodes.upper[d] - 1) return false;
  }
  return true;
}

/// The particles of a cell of the patch.
template <class Shape, int D = Shape::dimension>
void scatterCell(const Level& level, const Material& material, const Sources<Shape>& from, const Index<D>& cell,
                 const data::ParticleRange& range, const NodeView<NodeRecord>& record) {
  for (int at = range.first; at < range.last; at += stressGroup)
    scatterGroup<Shape, false>(level, material, from, cell, at, std::min(stressGroup, range.last - at), record);
}

/// The particles of a ghost cell: those that touch the patch's own nodes.
template <class Shape, int D = Shape::dimension>
void scatterGhosts(const Level& level, const Material& material, const Sources<Shape>& from, const Index<D>& cell,
                   const data::ParticleRange& range, const NodeView<NodeRecord>& record) {
  const CellFrame<D> frame(level, cell);
  const auto isNear = [&](int p) { return touches<Shape>(frame, cell, from.x[p], from.extents[p], record.box()); };
  for (int first = range.first; first < range.last;) {
    while (first < range.last && !isNear(first)) ++first;
    int end = first;
    while (end < range.last && end - first < stressGroup && isNear(end)) ++end;
    if (first < end) scatterGroup<Shape, true>(level, material, from, cell, first, end - first, record);
    first = end;
  }
}

/// What particles bring to the patch's own nodes: complete on all that are touched; what is not touched is 0 where
/// `clearsAll`, else undefined.
template <class Shape, int D = Shape::dimension>
void scatterParticles(const Patch& patch, const Material& material, bool clearsAll, const Sources<Shape>& from,
                      NodeView<NodeRecord> record) {
  const ParticleView<const Vec<D>> x = from.x;
  const TouchedRows<D> rows(x, x.cells(), Shape::ghostNodes, record.box());
  if (clearsAll)
    record.fill(NodeRecord{});
  else
    rows.forEachRow([&](const Index3& first, int end) {
      std::fill_n(record.values() + record.stored().offset(first), end - first[0], NodeRecord{});
    });
  x.template forEachOccupied<D>(x.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    if (patch.cells().contains(cell))
      scatterCell<Shape>(patch.level(), material, from, cell, range, record);
    else
      scatterGhosts<Shape>(patch.level(), material, from, cell, range, record);
  });
  rows.forEachRow([&](const Index3& first, int end) {
    NodeRecord* node = record.values() + record.stored().offset(first);
    for (int k = first[0]; k < end; ++k, ++node)
      if ((*node)[lane::mass] > 0)
        setLanes<D>(*node, lane::velocity, lanes<D>(*node, lane::velocity) / (*node)[lane::mass]);
  });
  setSymmetry<D>(patch, material.index, record);
}

/// m_i = sum_p S_i m_p,   v_i = sum_p S_i m_p v_p / m_i,
/// f_i = sum_p S_i f_p - V_p (sigma_p - q_p I) grad S_i; where axisymmetric, the hoop stress pulls inwards with S_i /
/// r. Complete on all own nodes of the patch that are touched; what is not touched is 0 where `clearsAll`, else
/// undefined.
template <class Shape, int D = Shape::dimension>
void interpolateParticlesToGrid(const Patch& patch, const Material& material, const Vec3& commonSize, bool clearsAll,
                                ParticleView<const Vec<D>> x, OptionalView<const Vec<D>> size,
                                ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
                                OptionalView<const Matrix3> deformation, OptionalView<const double> volume,
                                OptionalView<const Matrix3> stress, OptionalView<const double> viscosity,
                                OptionalView<const Vec<D>> externalForce, NodeView<NodeRecord> record) {
  const Level& level = patch.level();
  const Sources<Shape> from{Extents<Shape>(level, commonSize, size, deformation),
                            x,
                            velocity,
                            valuesOf(mass),
                            valuesOf(volume),
                            valuesOf(viscosity),
                            valuesOf(stress),
                            valuesOf(deformation),
                            valuesOf(externalForce)};
  scatterParticles<Shape>(patch, material, clearsAll, from, record);
}

}  // namespace tushar::mpm::solid
