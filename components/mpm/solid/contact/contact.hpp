#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "components/mpm/solid/kernels/node_record.hpp"
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
  std::array<bool, 3> direction{false, false, true};  ///< along x, y, z the others follow the master
  double stopTime = std::numeric_limits<double>::max();  ///< s
  Vec3 velocityAfterStop = Vec3::Zero();              ///< m/s
  std::vector<std::pair<double, Vec3>> profile;       ///< time (s) and the master's velocity (m/s); empty: it is free

  double friction = 0;                                ///< coefficient mu
  double separationFactor = 0;                        ///< of friction: farther apart than so many cells they do not touch

  bool concerns(int material) const;
  /// The master's velocity at a time, where it is given.
  std::optional<Vec3> prescribedVelocity(double time) const;
};

/// The records of all materials (see NodeRecord), whose lanes 0 to 2 are the velocity.
using Records = std::vector<NodeView<Octet>>;

/// All materials that take part get the velocity of their centre of mass.
template <int D>
void moveAsOne(const Patch& patch, const Contact& contact, const Records& records);
/// Where the master is, the others get its velocity along the contact's directions. Adds what that takes to `reaction`,
/// the force (N) on all of them.
template <int D>
void followMaster(const Patch& patch, const Contact& contact, double time, double dt, const Records& records,
                  VectorSum& reaction);

/// Whether a node belongs to a patch and to no other: sums over nodes count it once.
template <int D>
bool isOwned(const Patch& patch, const Index<D>& node) {
  for (int d = 0; d < D; ++d)
    if (node[d] >= patch.cells().upper[d] && !patch.isAtBoundary(d, 1)) return false;
  return true;
}

}  // namespace tushar::mpm::solid
