#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "components/mpm/solid/transfer/node_record.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// How materials act on each other where they share nodes: one `contact` of a scene.
struct Contact {
  enum class Type {
    singleVelocity,  ///< they move as one: no slip, no separation
    specified,       ///< they follow a master, whose velocity may be given over time
    friction,        ///< they part freely and slide with Coulomb's friction
  };

  Type type = Type::singleVelocity;
  std::vector<int> materials;  ///< that take part; empty: all
  int master = 0;
  std::array<bool, 3> direction{false, false, true};     ///< along x, y, z the others follow the master
  bool directionIsGiven = false;                         ///< by the scene
  double stopTime = std::numeric_limits<double>::max();  ///< s
  Vec3 velocityAfterStop = Vec3::Zero();                 ///< m/s
  std::vector<std::pair<double, Vec3>> profile;  ///< time (s) and the master's velocity (m/s); empty: it is free

  bool actsTwice = true;  ///< on the velocities that came from the particles, too
  int excluded = -1;      ///< where this material is, nothing follows a master or moves as one; -1: none

  double friction = 0;          ///< coefficient mu
  bool onlyOnApproach = false;  ///< friction: what the stress presses together may part
  bool normalsInCells =
      false;  ///< friction: mass gradients are taken per cell, not per m, as axisymmetric ones in Uintah
  bool keepsMomentum = false;   ///< friction: one normal for all, who are pressed where the stresses of all press
  double separationFactor = 0;  ///< friction: farther apart than so many cells they do not touch
  double volumeConstraint = 0;  ///< friction: the share of the volume around a node that must be filled for a contact

  bool concerns(int material) const;
  /// The master's velocity at a time, where it is given.
  std::optional<Vec3> prescribedVelocity(double time) const;
};

/// Which velocity of a step the records hold.
enum class Moment {
  start,  ///< what came from the particles
  end,    ///< v* after the forces
};

/// The records of all materials (see NodeRecord), whose lanes 0 to 2 are the velocity.
using Records = std::vector<NodeView<NodeRecord>>;

/// All materials that take part get the velocity of their centre of mass.
template <int D>
void moveAsOne(const Patch& patch, const Contact& contact, const Records& records);
/// Where the master is, the others get its velocity along the contact's directions.
template <int D>
void followMaster(const Patch& patch, const Contact& contact, double time, const Records& records);

/// What has changed the velocities of a step besides the forces of stresses and loads.
struct Acceleration {
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  double damping = 0;           ///< 1/s
};
/// Where the master is, adds to `reaction` the force (N) that holds the others against their stresses and loads, as
/// Uintah counts it: - sum m ((v* - v) / dt - g + damping v). The records hold v* and v before the contact.
template <int D>
void sumReaction(const Patch& patch, const Contact& contact, const Acceleration& acceleration, double dt,
                 const Records& records, VectorSum& reaction);

/// Whether a node belongs to a patch and to no other: sums over nodes count it once.
template <int D>
bool isOwned(const Patch& patch, const Index<D>& node) {
  for (int d = 0; d < D; ++d)
    if (node[d] >= patch.cells().upper[d] && !patch.isAtBoundary(d, 1)) return false;
  return true;
}

}  // namespace tushar::mpm::solid
