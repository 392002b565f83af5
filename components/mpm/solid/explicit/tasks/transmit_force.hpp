#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"
#include "core/data/vanished.hpp"

// Materials that transmit force: each moves as one rigid body by the sum of the forces on it, as in Uintah.

namespace tushar::mpm::solid {

/// The mass [kg] of a material on the patches of a rank, and the force [N] on it.
struct Pull {
  Sum mass;
  VectorSum force;

  void merge(const Pull& other) {
    mass.merge(other.mass);
    force.merge(other.force);
  }
  Vec3 acceleration() const { return Vec3(force.x.total(), force.y.total(), force.z.total()) / mass.total(); }
};

/// The variables on a patch from which the motion of a material as a rigid body follows.
template <int D>
struct RigidMotion {
  ParticleView<const Vec<D>> x;
  ParticleView<const double> mass;
  ParticleView<const Vec<D>> externalForce;
  NodeView<const Vec<D>> transmitted;
  std::optional<NodeView<const Vec<D>>> surrounding;  ///< force of the surrounding medium, if there is one
  NodeView<NodeRecord> record;

  static RigidMotion from(auto& take, int reach, bool isSurrounded) {
    return {.x = take(requiresOld(p::x<D>, reach)),
            .mass = take(requiresOld(p::mass)),
            .externalForce = take(requiresNew(p::externalForce<D>)),
            .transmitted = take(requiresNew(g::transmittedForce<D>)),
            .surrounding = take(when(isSurrounded, requiresNew(g::surroundingForce<D>))),
            .record = take(modifies(g::record))};
  }
};

/// Adds the loads on a material within a patch, and the forces that contact and the surrounding medium exert on it.
template <int D>
void addPull(const Patch& patch, const RigidMotion<D>& u, Pull& pull) {
  for (int p = 0; p < u.mass.owned(); ++p) {
    pull.mass.add(u.mass[p]);
    pull.force.add(patch.level().expandDirection<D>(u.externalForce[p]));
  }
  forEach<D>(u.transmitted.box(), [&](const Index<D>& node) {
    if (!countsOnce<D>(patch, node)) return;
    pull.force.add(patch.level().expandDirection<D>(u.transmitted[node]));
    if (u.surrounding) pull.force.add(patch.level().expandDirection<D>((*u.surrounding)[node]));
  });
}

/// Computes v* = v + a dt at the nodes near particles.
template <int D>
void accelerate(ParticleView<const Vec<D>> x, int ghostNodes, const Vec<D>& change, NodeView<NodeRecord> record) {
  touchedRows<D>(x, ghostNodes).forEachRow(record.box(), [&](const Index3& first, int end) {
    NodeRecord* node = record.values() + record.stored().offset(first);
    for (int k = first[0]; k < end; ++k, ++node)
      setLanes<D>(*node, lane::velocity, lanes<D>(*node, lane::before) + change);
  });
}

/// Accelerates all nodes of a material that transmits force by (sum of its loads and of the transmitted forces) / mass,
/// regardless of the conditions at the sides of the grid. The motions are indexed by patch, then by material.
template <int D>
void computeGridVelocityForFTM(const RankPatches& patches, const std::vector<Material>& materials,
                               const mpi::Communicator& ranks, int ghostNodes, double dt,
                               const std::vector<std::vector<RigidMotion<D>>>& motions) {
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (!materials[m].transmitsForce) continue;
    Pull pull;
    for (std::size_t p = 0; p < patches.size(); ++p) addPull<D>(*patches[p], motions[p][m], pull);
    ranks.merge(pull);
    if (!(pull.mass.total() > 0)) continue;
    for (std::size_t p = 0; p < patches.size(); ++p)
      accelerate<D>(motions[p][m].x, ghostNodes, patches[p]->level().template reduce<D>(pull.acceleration() * dt),
                    motions[p][m].record);
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
