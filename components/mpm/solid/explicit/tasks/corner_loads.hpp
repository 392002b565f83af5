#pragma once

#include <cmath>

#include "components/mpm/solid/loads/loaded_face.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/boundary.hpp"
#include "components/mpm/solid/transfer/placed.hpp"

// The tasks of use_CBDI_boundary_condition: pressures act at the corners of the faces of particles.

namespace tushar::mpm::solid {

/// Number of layers of cells around a patch whose particles may have a corner next to the nodes of the patch.
inline constexpr int cornerReach = 2;

/// Views of particles on which loads act.
template <int D>
struct LoadedParticles {
  ParticleView<const Vec<D>> x;
  Sizes<D> size;
  ParticleView<const Matrix3> deformation;
  ParticleView<const int> loadCurves;

  static LoadedParticles from(auto& take, KeptSizes keepsSizes, int reach) {
    return {.x = take(requiresOld(p::x<D>, reach)),
            .size = Sizes<D>::from(take, keepsSizes, reach),
            .deformation = take(requiresOld(p::deformationMeasure, reach)),
            .loadCurves = take(requiresOld(p::loadCurves, reach))};
  }
  /// Particle p as a parallelepiped. Along axes that the grid does not use, its initial edge is 1 m.
  ParticleBox box(const Level& level, const Vec3& commonSize, int p) const {
    Vec3 edges = Vec3::Ones();
    for (int d = 0; d < D; ++d)
      edges[level.axis(d)] = (size.each ? (*size.each)[p][d] : commonSize[level.axis(d)]) * level.spacing(d);
    Matrix3 start = edges.asDiagonal();
    if (size.domain) {
      start = (*size.domain)[p];
      for (int d = 0; d < D; ++d) start.row(level.axis(d)) *= level.spacing(d);
    }
    return {level.expandPoint<D>(x[p]), start, deformation[p] * start};
  }
};

/// Computes the force of loads on each particle at the start of the step, for loads that act at corners.
template <int D>
void applyLoadsAtCorners(const Patch& patch, const Material&, const Loads& loads, const Vec3& commonSize, double time,
                         const LoadedParticles<D>& particles, ParticleView<Vec<D>> externalForce) {
  const Level& level = patch.level();
  for (int p = 0; p < particles.loadCurves.owned(); ++p) {
    externalForce[p] = Vec<D>::Zero();
    if (particles.loadCurves[p] == 0) continue;
    const auto load = cornerLoad(loads, particles.loadCurves[p], particles.box(level, commonSize, p), time);
    if (load) externalForce[p] = level.reduce<D>(load->force);
  }
}

/// Adds N_i(x) times `force` to f_i; N_i are the tent functions of the cell that contains x.
template <int D>
void addForceAt(const Level& level, const Vec<D>& x, const Vec<D>& force, NodeView<NodeRecord> record) {
  Index<D> cell;
  Vec<D> within;
  for (int d = 0; d < D; ++d) {
    const double at = (x[d] - level.nodePosition(d, 0)) * level.inverseSpacing(d);
    cell[d] = static_cast<int>(std::floor(at));
    within[d] = at - cell[d];
  }
  const auto weights = Linear<D>::weights(within);
  for (int k = 0; k < Linear<D>::nodes; ++k) {
    const Index<D> node = Linear<D>::node(cell, k);
    if (!record.box().contains(node)) continue;
    NodeRecord& at = record[node];
    setLanes<D>(at, lane::force, lanes<D>(at, lane::force) + weights[k] * force);
  }
}

/// Where the corners of a particle at x may lie along an axis: at most a cell from x. For GIMP functions, whose extent
/// `edge` [m] does not follow F, also between nodes within reach of the particle, less .001 of a cell. Otherwise, the
/// corner of a turned particle could push a node to which its particle gives almost no mass: the force falls with the
/// distance to the edge of the support, the mass with its square, and the velocity of the node would be without bounds.
template <int D>
std::array<double, 2> roomOfCorners(const Level& level, int d, double x, double edge, bool isGimp) {
  const double h = level.spacing(d), reach = h + 0.5 * edge - 0.001 * h, first = level.nodePosition(d, 0);
  if (!isGimp) return {x - h, x + h};
  return {std::max(x - h, first + h * std::ceil((x - reach - first) / h)),
          std::min(x + h, first + h * std::floor((x + reach - first) / h))};
}

/// Adds the forces of loads to the nodes around the corners on which the loads act. `isGimp` tells whether shape
/// functions contain the sizes of particles, but do not follow F.
template <int D>
void addLoadsAtCorners(const Patch& patch, const Material& material, const Loads& loads, const Vec3& commonSize,
                       bool isGimp, double time, const LoadedParticles<D>& particles, NodeView<NodeRecord> record) {
  const Level& level = patch.level();
  const auto& x = particles.x;
  x.template forEachOccupied<D>(x.cells(), [&](const Index<D>&, const data::ParticleRange& range) {
    for (const int p : range) {
      if (particles.loadCurves[p] == 0) continue;
      const ParticleBox box = particles.box(level, commonSize, p);
      const auto load = cornerLoad(loads, particles.loadCurves[p], box, time);
      if (!load) continue;
      for (const Vec3& corner : load->corners) {
        Vec<D> at = level.reduce<D>(corner);
        for (int d = 0; d < D; ++d) {
          const double edge = box.startEdges(level.axis(d), level.axis(d));
          const auto [lowest, highest] = roomOfCorners<D>(level, d, x[p][d], edge, isGimp);
          at[d] = std::clamp(at[d], lowest, highest);
        }
        addForceAt<D>(level, at, Vec<D>(0.25 * level.reduce<D>(load->force)), record);
      }
    }
  });
  setSymmetry<D>(patch, material.index, data::TouchedRows::all(record.box()), record);
}

}  // namespace tushar::mpm::solid
