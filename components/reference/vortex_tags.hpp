#pragma once

#include <string>

#include "components/reference/moving_frame.hpp"
#include "core/grid/level.hpp"
#include "core/input/schema.hpp"

namespace tushar::reference {

/// What the modules of vortices have in common.
struct VortexTags {
  std::string name;
  double gamma = 1.4;
  int axis = 2;
  Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();
};

/// Declares them as tags of the module `name`; S is derived from VortexTags.
template <class S>
void declareVortexTags(input::Schema<S>& schema, const std::string& name) {
  schema.requiredAttribute("name", static_cast<std::string S::*>(&S::name), "1", name)
      .required("centre", static_cast<Vec3 S::*>(&S::centre), "m", "where the vortex is at t = 0")
      .ours()
      .value("velocity", static_cast<Vec3 S::*>(&S::velocity), Vec3::Zero(), "m/s", "of the flow that carries it along")
      .ours()
      .template choice<int>("axis", static_cast<int S::*>(&S::axis), {{"x", 0}, {"y", 1}, {"z", 2}}, 2,
                            "what it turns around")
      .ours()
      .value("gamma", static_cast<double S::*>(&S::gamma), 1.4, "1", "ratio of specific heats", input::greaterThan(1))
      .ours();
}

/// Where the vortex goes on a grid, which may repeat. Throws std::invalid_argument where the plane in which it turns is
/// not in the grid.
MovingFrame frameOf(const VortexTags& tags, const grid::Level& level);

}  // namespace tushar::reference
