#pragma once

#include "components/mpm/solid/implicit/particles.hpp"
#include "components/mpm/solid/implicit/system.hpp"

namespace tushar::mpm::solid::implicit {

/// A rigid body on the grid: the nodes near its particles, and their displacement in the step.
template <int D>
class RigidBody {
 public:
  RigidBody(const RankPatches& patches, const mpi::Communicator& ranks, const ImplicitSetup<D>& setup, int material,
            double time, double dt, const OfRank<SolidParticles<D>>& particles)
      : level_(&patches.front()->level()), nodes_(*level_, ranks), contact_(setup.rigidContact(material)) {
    const auto forEachTouch = [&](auto&& visit) { forEachShare(patches, setup, material, particles, visit); };
    forEachTouch([&](const Index<D>& node, double, const Vec<D>&) { nodes_.touch(node); });
    nodes_.number(patches, setup.shapes->shaped.shape.ghostNodes + 1);
    std::vector<double> sums(nodes_.size() * (D + 1), 0.0);  // mass, momentum of each node
    forEachTouch([&](const Index<D>& node, double mass, const Vec<D>& velocity) {
      double* sum = &sums[nodes_(node) * (D + 1)];
      sum[0] += mass;
      Eigen::Map<Vec<D>>(sum + 1) += mass * velocity;
    });
    solvers::addUp(nodes_.unknowns(D + 1), sums);
    const auto given = contact_->prescribedVelocity(time + dt / 2);
    for (int k = 0; k < nodes_.size(); ++k) {
      const double* sum = &sums[k * (D + 1)];
      moved_.push_back(given ? Vec<D>(dt * level_->reduce<D>(*given))
                             : Vec<D>(dt / sum[0] * Eigen::Map<const Vec<D>>(sum + 1)));
    }
  }

  /// Displacement of a node in the step [m]; none for nodes that the body does not touch.
  std::optional<Vec<D>> operator()(const Index<D>& node) const {
    const auto image = nodes_.imageOf(node);
    const int number = nodes_(image.node);
    if (number < 0) return std::nullopt;
    return Vec<D>(image.sign.cwiseProduct(moved_[number]));
  }
  /// Adds the forces with which the body holds the solid along the `direction` of the contact, at the nodes of this
  /// rank.
  void addReaction(const ImplicitSystem<D>& system, VectorSum& reaction) const {
    const std::vector<double> forces = system.reactions();
    for (int k = 0; k < system.nodes().owned(); ++k) {
      if (!(*this)(system.nodes().node(k))) continue;
      Vec<D> force = Eigen::Map<const Vec<D>>(forces.data() + D * k);
      for (int d = 0; d < D; ++d)
        if (!contact_->direction[level_->axis(d)]) force[d] = 0;
      reaction.add(level_->template expandDirection<D>(force));
    }
  }
  /// Makes the solid move with the body at the nodes that both touch.
  void prescribe(ImplicitSystem<D>& system) const {
    for (int k = 0; k < system.nodes().size(); ++k)
      if (const auto moved = (*this)(system.nodes().node(k)))
        for (int d = 0; d < D; ++d)
          if (contact_->direction[level_->axis(d)]) system.prescribe(k, d, (*moved)[d]);
  }

 private:
  /// Calls `visit(node, mass, velocity)` for each particle of the body and each node that receives part of its mass.
  template <class Visit>
  void forEachShare(const RankPatches& patches, const ImplicitSetup<D>& setup, int material,
                    const OfRank<SolidParticles<D>>& particles, Visit&& visit) const {
    std::vector<ParticlesOnPatch<D>> list;
    for (std::size_t p = 0; p < patches.size(); ++p)
      list.push_back({patches[p], particles[p][material].placed.x, material});
    for (const OccupiedCell& of : occupiedCells<D>(list)) {
      const SolidParticles<D>& body = particles[of.source][material];
      const auto visitOne = [&](int k, std::span<const Touch<D>> touched) {
        for (const Touch<D>& touch : touched) {
          const auto image = nodes_.imageOf(touch.node);
          if (touch.s > 0) visit(image.node, touch.s * body.mass[k], image.sign.cwiseProduct(body.velocity[k]));
        }
      };
      setup.shapes->forEachTouched(*patches[of.source], of.cell, body.placed, setup.problem->method.commonSize,
                                   visitOne);
    }
  }

  const Level* level_;
  NodeMap<D> nodes_;
  const Contact* contact_;
  std::vector<Vec<D>> moved_;
};

}  // namespace tushar::mpm::solid::implicit
