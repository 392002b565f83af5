#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "core/core.hpp"

namespace tushar::mpm::solid {

/// How materials act on each other where they share nodes: one `contact` of a scene.
struct Contact {
  enum class Type {
    singleVelocity,  ///< they move as one: no slip, no separation
    specified,       ///< they follow a master, whose velocity may be given over time
  };

  Type type = Type::singleVelocity;
  std::vector<int> materials;  ///< that take part; empty: all
  int master = 0;
  std::array<bool, 3> direction{false, false, true};  ///< along x, y, z the others follow the master
  double stopTime = std::numeric_limits<double>::max();  ///< s
  Vec3 velocityAfterStop = Vec3::Zero();              ///< m/s
  std::vector<std::pair<double, Vec3>> profile;       ///< time (s) and the master's velocity (m/s); empty: it is free

  bool concerns(int material) const;
  /// The master's velocity at a time, where it is given.
  std::optional<Vec3> prescribedVelocity(double time) const;
};

/// The velocities of all materials at a node, after one contact.
template <int D>
using NodeVelocities = std::vector<NodeView<Vec<D>>>;
using NodeMasses = std::vector<NodeView<const double>>;

template <int D>
void moveAsOne(const Patch& patch, const Contact& contact, const NodeMasses& mass, const NodeVelocities<D>& velocity);
template <int D>
void followMaster(const Patch& patch, const Contact& contact, double time, const NodeMasses& mass,
                  const NodeVelocities<D>& velocity);

}  // namespace tushar::mpm::solid
