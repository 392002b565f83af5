#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

// Materials that transmit force: each moves as one rigid body by the sum of what acts on it, as in Uintah.

namespace tushar::mpm::solid {

/// Adds `share` of the momentum that the materials of a contact have at the nodes where its master is, kg m/s.
template <int D>
void addMomentum(const Contact& contact, const Records& records, double share, NodeView<Vec<D>> sum) {
  forEach<D>(sum.box(), [&](const Index<D>& node) {
    if (records[static_cast<std::size_t>(contact.master)][node][lane::mass] == 0) return;
    for (std::size_t m = 0; m < records.size(); ++m)
      if (const NodeRecord& record = records[m][node]; contact.concerns(static_cast<int>(m)) && record[lane::mass] != 0)
        sum[node] += share * record[lane::mass] * lanes<D>(record, lane::velocity);
  });
}

/// Contact at the end of a step as in exMomIntegrated, and what it takes from the others for a master that transmits
/// force:
/// - sum m (v* after - v* before) / dt at each node, N.
template <int D>
void exMomIntegratedTransmitting(const Patch& patch, const std::vector<Material>& materials,
                                 const std::vector<Contact>& contacts, const Acceleration& acceleration, double time,
                                 double dt, const Records& records, VectorSum& reaction,
                                 const std::vector<NodeView<Vec<D>>>& transmitted) {
  for (NodeView<Vec<D>> force : transmitted) force.fill(Vec<D>::Zero());
  for (const Contact& contact : contacts) {
    const auto master = static_cast<std::size_t>(contact.master);
    const bool transmits = contact.type == Contact::Type::specified && materials[master].transmitsForce;
    if (transmits) addMomentum<D>(contact, records, 1 / dt, transmitted[master]);
    exMomIntegrated<D>(patch, materials, {contact}, acceleration, time, dt, records, reaction);
    if (transmits) addMomentum<D>(contact, records, -1 / dt, transmitted[master]);
  }
}

/// The mass (kg) and the force (N) of a material on the patches of a rank.
struct Pull {
  Sum mass;
  VectorSum force;

  void merge(const Pull& other) {
    mass.merge(other.mass);
    force.merge(other.force);
  }
  Vec3 acceleration() const { return Vec3(force.x.total(), force.y.total(), force.z.total()) / mass.total(); }
};

/// Adds what acts on a material within a patch.
template <int D>
void addPull(const Patch& patch, ParticleView<const double> mass, ParticleView<const Vec<D>> externalForce,
             NodeView<const Vec<D>> transmitted, Pull& pull) {
  for (int p = 0; p < mass.owned(); ++p) {
    pull.mass.add(mass[p]);
    pull.force.add(patch.level().expandDirection<D>(externalForce[p]));
  }
  forEach<D>(transmitted.box().intersect(patch.level().nodesOfCells()), [&](const Index<D>& node) {
    if (isOwned<D>(patch, node)) pull.force.add(patch.level().expandDirection<D>(transmitted[node]));
  });
}

/// v* = v + a dt at the nodes that particles touch.
template <class Shape, int D = Shape::dimension>
void accelerate(ParticleView<const Vec<D>> x, const Vec<D>& change, NodeView<NodeRecord> record) {
  const TouchedRows<D> rows(x, x.cells(), Shape::ghostNodes, record.box());
  rows.forEachRow([&](const Index3& first, int end) {
    NodeRecord* node = record.values() + record.stored().offset(first);
    for (int k = first[0]; k < end; ++k, ++node)
      setLanes<D>(*node, lane::velocity, lanes<D>(*node, lane::before) + change);
  });
}

/// Gives all nodes of a material that transmits force the acceleration (sum of its loads and of what is transmitted) /
/// mass, whatever holds on the sides of the grid.
template <class Shape, int D = Shape::dimension>
void computeGridVelocityForFTM(const RankPatches& patches, const std::vector<Material>& materials,
                               const mpi::Communicator& ranks, double dt,
                               const std::vector<std::vector<ParticleView<const Vec<D>>>>& x,
                               const std::vector<std::vector<ParticleView<const double>>>& mass,
                               const std::vector<std::vector<ParticleView<const Vec<D>>>>& externalForce,
                               const std::vector<std::vector<NodeView<const Vec<D>>>>& transmitted,
                               const std::vector<std::vector<NodeView<NodeRecord>>>& records) {
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (!materials[m].transmitsForce) continue;
    Pull pull;
    for (std::size_t p = 0; p < patches.size(); ++p)
      addPull<D>(*patches[p], mass[p][m], externalForce[p][m], transmitted[p][m], pull);
    ranks.merge(pull);
    if (!(pull.mass.total() > 0)) continue;
    for (std::size_t p = 0; p < patches.size(); ++p)
      accelerate<Shape>(x[p][m], patches[p]->level().template reduce<D>(pull.acceleration() * dt), records[p][m]);
  }
}

}  // namespace tushar::mpm::solid
