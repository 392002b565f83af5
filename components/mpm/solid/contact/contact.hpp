#pragma once

#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "components/mpm/solid/transfer/node_record.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// A number or vector as a function of time [s]: linear between its entries, constant before the first and after the
/// last.
template <class T>
using Profile = std::vector<std::pair<double, T>>;

/// The prescribed motion of a master at one time: it translates, and rotates about an axis through a centre.
struct Motion {
  Vec3 velocity = Vec3::Zero();         ///< translational velocity [m/s]
  Vec3 centre = Vec3::Zero();           ///< centre of the rotation [m]
  Vec3 angularVelocity = Vec3::Zero();  ///< angular velocity [1/s]

  /// The velocity [m/s] that moves a point in dt to its prescribed position: along the chord of its circle if the axis
  /// is nearly parallel to an axis of the grid (cos > 0.99), otherwise omega x r, as in Uintah.
  Vec3 at(const Vec3& point, double dt) const;
};

/// How materials interact where they share nodes: one `contact` of a scene.
struct Contact {
  enum class Type {
    singleVelocity,  ///< the materials move as one: no slip, no separation
    specified,       ///< the materials follow a master, whose velocity may be given over time
    friction,        ///< the materials separate freely and slide with Coulomb friction
    planeFriction,   ///< like friction, along the plane that separates their particles (see SeparatingPlane)
    /// The materials separate from a master, whose velocity may be given, and slide on it along the separating planes.
    specifiedFriction,
  };

  Type type = Type::singleVelocity;
  std::vector<int> materials;  ///< indices of the materials that take part; empty: all
  int master = 0;
  /// Whether the other materials follow the master along x, y, z.
  std::array<bool, 3> direction{false, false, true};
  bool directionIsGiven = false;                         ///< whether `direction` is given in the scene
  Location where;                                        ///< location of its tag in the scene
  double stopTime = std::numeric_limits<double>::max();  ///< stop time [s]
  Vec3 velocityAfterStop = Vec3::Zero();                 ///< velocity after stop [m/s]
  /// The master's velocity over time [m/s]; empty: the master moves freely.
  Profile<Vec3> profile;
  /// Centre [m] and angular velocity [1/s] of the master's rotation; empty: no rotation.
  Profile<Vec3> centres, angularVelocity;

  bool actsTwice = true;  ///< whether the contact also acts on the velocities interpolated from the particles
  int excluded = -1;      ///< index of the material that disables the contact at its nodes; -1: none

  double friction = 0;  ///< friction coefficient mu
  Profile<double>
      frictionOfColor;          ///< mu as a function of p.color of the master, instead of time; empty: mu is `friction`
  bool onlyOnApproach = false;  ///< friction only: whether bodies may separate even under compression
  bool normalsInCells =
      /// Friction only: whether mass gradients are per cell instead of per m, as in Uintah's axisymmetric scenes.
      false;
  /// Friction only: whether bodies that meet share one normal; otherwise each has its own.
  bool oneNormal = true;
  bool keepsMomentum = false;   ///< friction only: one normal for all, and contact only if all stresses are compressive
  double separationFactor = 0;  ///< friction only: distance in cells beyond which bodies do not touch
  double volumeConstraint = 0;  ///< friction only: fraction of the volume around a node that must be filled for contact

  bool concerns(int material) const;
  /// The indices of those among the first `count` materials that take part.
  std::vector<std::size_t> bodies(std::size_t count) const;
  /// For each of `count` materials, whether it takes part.
  std::vector<bool> takingPart(std::size_t count) const;
  /// Whether the other materials follow or meet a master.
  bool hasMaster() const { return type == Type::specified || type == Type::specifiedFriction; }
  /// Whether bodies touch along planes that separate their particles.
  bool usesPlanes() const { return type == Type::planeFriction || type == Type::specifiedFriction; }
  /// Whether the contact reads the records of bodies at nodes that they do not touch.
  bool readsAllNodes() const { return type != Type::friction && type != Type::planeFriction; }
  /// The master's motion at a time, if it is prescribed.
  std::optional<Motion> prescribedMotion(double time) const;
  /// The master's velocity at a time, if it is prescribed.
  std::optional<Vec3> prescribedVelocity(double time) const;
};

/// The stage of the step to which the velocity in the records belongs.
enum class Moment {
  start,  ///< the velocity interpolated from the particles
  end,    ///< the velocity v* after the forces
};

/// The records of all materials (see NodeRecord), whose lanes 0 to 2 are the velocity.
using Records = std::vector<NodeView<NodeRecord>>;

/// Gives all participating materials the velocity of their centre of mass.
template <int D>
void moveAsOne(const Patch& patch, const Contact& contact, const Records& records);
/// At nodes of the master, gives the other materials its velocity along the directions of the contact.
template <int D>
void followMaster(const Patch& patch, const Contact& contact, double time, double dt, const Records& records);
/// The velocity of the master at a node [m/s]: its current velocity, unless its motion is prescribed.
template <int D>
Vec<D> masterVelocity(const Patch& patch, const Contact& contact, const std::optional<Motion>& motion, double dt,
                      const Records& records, const Index<D>& node);
/// The fraction of the mass at a node below which a mass is considered a rounding error.
inline constexpr double leastShare = 1e-14;

/// Whether a material is present at a node. By rounding, a particle may leave 1e-30 of its mass at a node at the very
/// edge of its support, which must not affect other bodies.
template <int D>
bool isPresent(const Records& records, int material, const Index<D>& node) {
  double total = 0;
  for (const auto& record : records) total += record[node][lane::mass];
  return total > 0 && records[material][node][lane::mass] >= leastShare * total;
}
/// Whether the material that disables a contact is present at a node.
template <int D>
bool isExcluded(const Contact& contact, const Records& records, const Index<D>& node) {
  return contact.excluded >= 0 && records[contact.excluded][node][lane::mass] != 0;
}

/// The causes, other than stresses and loads, of velocity changes in a step.
struct Acceleration {
  Vec3 gravity = Vec3::Zero();  ///< gravity [m/s^2]
  double damping = 0;           ///< damping [1/s]
};
/// The force that holds a body at a node against its stresses and loads [N]: - m ((v* - v) / dt - g + damping v) of a
/// record that holds v* and v.
template <int D>
Vec<D> heldForce(const NodeRecord& record, const Vec<D>& gravity, const Acceleration& acceleration, double dt) {
  const Vec<D> before = lanes<D>(record, lane::before), after = lanes<D>(record, lane::velocity);
  return -record[lane::mass] * ((after - before) / dt - gravity + acceleration.damping * before);
}
/// At nodes of the master, adds to `reaction` the force [N] that holds the other materials against their stresses and
/// loads, as in Uintah: - sum m ((v* - v) / dt - g + damping v). The records contain v* and v before the contact.
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

/// Whether sums over the nodes of the grid's cells count a node on this patch. Nodes beyond a symmetry plane do not
/// count: their records are those of their mirror images.
template <int D>
bool countsOnce(const Patch& patch, const Index<D>& node) {
  return isOwned<D>(patch, node) && patch.level().template isNodeInside<D>(node);
}

}  // namespace tushar::mpm::solid
