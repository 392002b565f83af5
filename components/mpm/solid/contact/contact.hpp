#pragma once

#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "components/mpm/solid/transfer/node_record.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// A number or vector over time, s: linear between its entries, constant before the first and after the last.
template <class T>
using Profile = std::vector<std::pair<double, T>>;

/// The prescribed motion of a master at one time: it translates, and rotates about an axis through a centre.
struct Motion {
  Vec3 velocity = Vec3::Zero();         ///< m/s
  Vec3 centre = Vec3::Zero();           ///< m
  Vec3 angularVelocity = Vec3::Zero();  ///< 1/s

  /// The velocity of a point, m/s, that moves it in dt to its prescribed position: along the chord of its circle if the
  /// axis is nearly parallel to one of the grid's (cos > 0.99), otherwise omega x r, as in Uintah.
  Vec3 at(const Vec3& point, double dt) const;
};

/// How materials interact where they share nodes: one `contact` of a scene.
struct Contact {
  enum class Type {
    singleVelocity,     ///< they move as one: no slip, no separation
    specified,          ///< they follow a master, whose velocity may be given over time
    friction,           ///< they separate freely and slide with Coulomb friction
    planeFriction,      ///< the same, along the plane that separates their particles (see SeparatingPlane)
    specifiedFriction,  ///< they separate from a master, whose velocity may be given, and slide on it along such planes
  };

  Type type = Type::singleVelocity;
  std::vector<int> materials;  ///< the materials that take part; empty: all
  int master = 0;
  std::array<bool, 3> direction{false, false, true};     ///< whether the others follow the master along x, y, z
  bool directionIsGiven = false;                         ///< whether it is given in the scene
  double stopTime = std::numeric_limits<double>::max();  ///< s
  Vec3 velocityAfterStop = Vec3::Zero();                 ///< m/s
  Profile<Vec3> profile;                                 ///< the master's velocity, m/s; empty: it is free
  Profile<Vec3> centres, angularVelocity;                ///< m, 1/s: the rotation of the master; empty: none

  bool actsTwice = true;  ///< whether it also acts on the velocities interpolated from the particles
  int excluded = -1;      ///< the material that disables the contact at its nodes; -1: none

  double friction = 0;  ///< coefficient mu
  Profile<double>
      frictionOfColor;          ///< mu as a function of p.color of the master, instead of time; empty: mu is `friction`
  bool onlyOnApproach = false;  ///< friction: bodies under compression may also separate
  bool normalsInCells =
      false;  ///< friction: mass gradients are per cell instead of per m, as in axisymmetric scenes of Uintah
  bool oneNormal = true;        ///< friction: bodies that meet share their normal; otherwise each has its own
  bool keepsMomentum = false;   ///< friction: one normal, and contact if all stresses are compressive
  double separationFactor = 0;  ///< friction: bodies farther apart than this many cells do not touch
  double volumeConstraint =
      0;  ///< friction: the fraction of the volume around a node that must be filled for a contact

  bool concerns(int material) const;
  /// The materials among the first `count` that take part.
  std::vector<std::size_t> bodies(std::size_t count) const;
  /// Whether the others follow or meet a master.
  bool hasMaster() const { return type == Type::specified || type == Type::specifiedFriction; }
  /// Whether bodies touch along planes that separate their particles.
  bool usesPlanes() const { return type == Type::planeFriction || type == Type::specifiedFriction; }
  /// The master's motion at a time, if it is given.
  std::optional<Motion> prescribedMotion(double time) const;
  /// The master's velocity at a time, if it is given.
  std::optional<Vec3> prescribedVelocity(double time) const;
};

/// The stage of the step to which the velocity in the records belongs.
enum class Moment {
  start,  ///< interpolated from the particles
  end,    ///< v* after the forces
};

/// The records of all materials (see NodeRecord), whose lanes 0 to 2 are the velocity.
using Records = std::vector<NodeView<NodeRecord>>;

/// All participating materials get the velocity of their centre of mass.
template <int D>
void moveAsOne(const Patch& patch, const Contact& contact, const Records& records);
/// At nodes of the master, the other materials get its velocity along the directions of the contact.
template <int D>
void followMaster(const Patch& patch, const Contact& contact, double time, double dt, const Records& records);
/// The velocity of the master at a node, m/s: its current velocity, unless its motion is prescribed.
template <int D>
Vec<D> masterVelocity(const Patch& patch, const Contact& contact, const std::optional<Motion>& motion, double dt,
                      const Records& records, const Index<D>& node);
/// A smaller fraction of the mass at a node is considered a rounding error.
inline constexpr double leastShare = 1e-14;

/// Whether a material is present at a node: a particle just within reach of the node may leave 1e-30 of its mass there
/// by rounding, which must not affect other bodies.
template <int D>
bool isPresent(const Records& records, int material, const Index<D>& node) {
  double total = 0;
  for (const auto& record : records) total += record[node][lane::mass];
  return total > 0 && records[material][node][lane::mass] >= leastShare * total;
}
/// Whether the material that disables a contact is at a node.
template <int D>
bool isExcluded(const Contact& contact, const Records& records, const Index<D>& node) {
  return contact.excluded >= 0 && records[contact.excluded][node][lane::mass] != 0;
}

/// The causes, other than stresses and loads, of velocity changes in a step.
struct Acceleration {
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  double damping = 0;           ///< 1/s
};
/// The force that holds a body at a node against its stresses and loads, N: - m ((v* - v) / dt - g + damping v) of a
/// record that holds v* and v.
template <int D>
Vec<D> heldForce(const NodeRecord& record, const Vec<D>& gravity, const Acceleration& acceleration, double dt) {
  const Vec<D> before = lanes<D>(record, lane::before), after = lanes<D>(record, lane::velocity);
  return -record[lane::mass] * ((after - before) / dt - gravity + acceleration.damping * before);
}
/// At nodes of the master, adds to `reaction` the force (N) that holds the other materials against their stresses and
/// loads, as in Uintah: - sum m ((v* - v) / dt - g + damping v). The records hold v* and v before the contact.
template <int D>
void sumReaction(const Patch& patch, const Contact& contact, const Acceleration& acceleration, double dt,
                 const Records& records, VectorSum& reaction);

/// Whether a patch owns a node, so that sums over nodes count it only once.
template <int D>
bool isOwned(const Patch& patch, const Index<D>& node) {
  for (int d = 0; d < D; ++d)
    if (node[d] >= patch.cells().upper[d] && !patch.isAtBoundary(d, 1)) return false;
  return true;
}

}  // namespace tushar::mpm::solid
