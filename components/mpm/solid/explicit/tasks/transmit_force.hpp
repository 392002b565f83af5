#pragma once

#include <array>

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"
#include "core/data/vanished.hpp"

// Materials that transmit force: each moves as one rigid body by the sum of the forces on it, as in Uintah.

namespace tushar::mpm::solid {

/// The mass [kg] and momentum [kg m/s] of a material on the patches of a rank, the force [N] on it, and its mass at
/// nodes on symmetry planes, by kernel axis and side [kg].
struct Pull {
  Sum mass;
  VectorSum force, momentum;
  std::array<std::array<Sum, 2>, 3> onPlanes;

  void merge(const Pull& other) {
    mass.merge(other.mass);
    force.merge(other.force);
    momentum.merge(other.momentum);
    for (int d = 0; d < 3; ++d)
      for (const int side : {0, 1}) onPlanes[d][side].merge(other.onPlanes[d][side]);
  }
  Vec3 acceleration() const { return perMass(force); }
  Vec3 velocity() const { return perMass(momentum); }
  /// Whether the body is at a symmetry plane.
  bool isAt(int d, int side) const { return onPlanes[d][side].total() > leastShare * mass.total(); }

 private:
  Vec3 perMass(const VectorSum& sum) const { return Vec3(sum.x.total(), sum.y.total(), sum.z.total()) / mass.total(); }
};

/// The variables on a patch from which the motion of a material as a rigid body follows.
template <int D>
struct RigidMotion {
  ParticleView<const Vec<D>> x;
  ParticleView<const double> mass;
  ParticleView<const Vec<D>> velocity, externalForce;
  NodeView<const Vec<D>> transmitted;
  std::optional<NodeView<const Vec<D>>> surrounding;  ///< force of the surrounding medium, if there is one
  NodeView<NodeRecord> record;

  static RigidMotion from(auto& take, int reach, bool isSurrounded) {
    return {.x = take(requiresOld(p::x<D>, reach)),
            .mass = take(requiresOld(p::mass)),
            .velocity = take(requiresOld(p::velocity<D>)),
            .externalForce = take(requiresNew(p::externalForce<D>)),
            .transmitted = take(requiresNew(g::transmittedForce<D>)),
            .surrounding = take(when(isSurrounded, requiresNew(g::surroundingForce<D>))),
            .record = take(modifies(g::record))};
  }
};

/// Adds the mass of a node to that on the symmetry planes on which the node is.
template <int D>
void addOnPlanes(const Level& level, int material, const Index<D>& node, double mass, Pull& pull) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (node[d] == (side == 0 ? level.cells().lower[d] : level.cells().upper[d]) &&
          level.isSymmetry(d, side, material))
        pull.onPlanes[d][side].add(mass);
}

/// Adds the mass and momentum of a material within a patch, the loads on it, and the forces that contact and the
/// surrounding medium exert on it.
template <int D>
void addPull(const Patch& patch, int ghostNodes, int material, const RigidMotion<D>& u, Pull& pull) {
  for (int p = 0; p < u.mass.owned(); ++p) {
    pull.mass.add(u.mass[p]);
    pull.momentum.add(patch.level().expandDirection<D>(Vec<D>(u.mass[p] * u.velocity[p])));
    pull.force.add(patch.level().expandDirection<D>(u.externalForce[p]));
  }
  forEach<D>(u.transmitted.box(), [&](const Index<D>& node) {
    if (!countsOnce<D>(patch, node)) return;
    pull.force.add(patch.level().expandDirection<D>(u.transmitted[node]));
    if (u.surrounding) pull.force.add(patch.level().expandDirection<D>((*u.surrounding)[node]));
  });
  forEachTouchedNode<D>(u.x, ghostNodes, u.record.box(), [&](const Index<D>& node) {
    if (countsOnce<D>(patch, node)) addOnPlanes<D>(patch.level(), material, node, u.record[node][lane::mass], pull);
  });
}

/// The change of the velocity of a material in a step, along the axes of the kernel [m/s]. Along the axes in `stops`
/// the body comes to rest.
template <int D>
struct RigidChange {
  Vec<D> change;
  std::array<bool, D> stops{};

  RigidChange(const Level& level, const Pull& pull, double dt) : change(level.reduce<D>(pull.acceleration() * dt)) {
    const Vec<D> after = level.reduce<D>(pull.velocity()) + change;
    for (int d = 0; d < D; ++d) stops[d] = (after[d] < 0 && pull.isAt(d, 0)) || (after[d] > 0 && pull.isAt(d, 1));
  }
};

/// Computes v* = v + a dt at the nodes near particles; 0 along axes along which the body comes to rest.
template <int D>
void accelerate(ParticleView<const Vec<D>> x, int ghostNodes, const RigidChange<D>& by, NodeView<NodeRecord> record) {
  touchedRows<D>(x, ghostNodes).forEachRow(record.box(), [&](const Index3& first, int end) {
    NodeRecord* node = record.values() + record.stored().offset(first);
    for (int k = first[0]; k < end; ++k, ++node) {
      Vec<D> velocity = lanes<D>(*node, lane::before) + by.change;
      for (int d = 0; d < D; ++d)
        if (by.stops[d]) velocity[d] = 0;
      setLanes<D>(*node, lane::velocity, velocity);
    }
  });
}

/// Accelerates all nodes of a material that transmits force by (sum of its loads and of the transmitted forces) / mass.
/// A symmetry plane that the body would cross stops it; other conditions at the sides of the grid do not act. The
/// motions are indexed by patch, then by material.
template <int D>
void computeGridVelocityForFTM(const RankPatches& patches, const std::vector<Material>& materials,
                               const mpi::Communicator& ranks, int ghostNodes, double dt,
                               const std::vector<std::vector<RigidMotion<D>>>& motions) {
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (!materials[m].transmitsForce) continue;
    Pull pull;
    for (std::size_t p = 0; p < patches.size(); ++p)
      addPull<D>(*patches[p], ghostNodes, static_cast<int>(m), motions[p][m], pull);
    ranks.merge(pull);
    if (!(pull.mass.total() > 0)) continue;
    for (std::size_t p = 0; p < patches.size(); ++p)
      accelerate<D>(motions[p][m].x, ghostNodes, RigidChange<D>(patches[p]->level(), pull, dt), motions[p][m].record);
  }
}

/// Moves the particles of a material that transmits force by the mean of its velocities before and after the step. They
/// have been moved by the latter: elastic bodies need this to be stable, but as a rigid body has no waves, the mean is
/// stable, and of second order in time.
template <int D>
void moveByMeanVelocity(const Patch&, const Material& material, double dt, ParticleView<const Vec<D>> before,
                        ParticleView<const Vec<D>> after, ParticleView<Vec<D>> x) {
  if (!material.transmitsForce) return;
  for (int p = 0; p < x.owned(); ++p)
    if (x[p][0] != data::removed) x[p] -= 0.5 * dt * (after[p] - before[p]);
}

}  // namespace tushar::mpm::solid
