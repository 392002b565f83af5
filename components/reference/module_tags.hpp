#pragma once

#include <optional>
#include <string>
#include <utility>

#include "components/reference/moving_frame.hpp"
#include "components/reference/within.hpp"
#include "core/grid/level.hpp"
#include "core/input/schema.hpp"

namespace tushar::reference {

/// What all modules that measure a gas have in common.
struct GasTags {
  std::string name;
  double gamma = 1.4;
  double pInfinity = 0;  ///< Pa; of a stiffened gas
  std::optional<Region> within;
};

/// `within`: a box.
const input::Schema<Region>& regionSchema();

/// A member of a base of S, as one of S.
template <class S, class T, class Base>
T S::*memberOf(T Base::*member) {
  return member;
}

/// The schema of the module `name` with those tags; S is derived from GasTags.
template <class S>
input::Schema<S> gasSchema(const std::string& name, std::string sentence, double gamma = 1.4) {
  return input::Schema<S>("Module", std::move(sentence))
      .requiredAttribute("name", memberOf<S>(&GasTags::name), "1", name)
      .value("gamma", memberOf<S>(&GasTags::gamma), gamma, "1", "ratio of specific heats", input::greaterThan(1))
      .ours()
      .section("within", memberOf<S>(&GasTags::within), regionSchema())
      .ours();
}

/// What the modules of vortices have in common.
struct VortexTags : GasTags {
  int axis = 2;
  Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();
};

/// The schema of the module `name` with those tags; S is derived from VortexTags.
template <class S>
input::Schema<S> vortexSchema(const std::string& name, std::string sentence) {
  return gasSchema<S>(name, std::move(sentence))
      .required("centre", memberOf<S>(&VortexTags::centre), "m", "where the vortex is at t = 0")
      .ours()
      .value("velocity", memberOf<S>(&VortexTags::velocity), Vec3::Zero(), "m/s", "of the flow that carries it along")
      .ours()
      .template choice<int>("axis", memberOf<S>(&VortexTags::axis), {{"x", 0}, {"y", 1}, {"z", 2}}, 2,
                            "what it turns around")
      .ours();
}

/// Where the vortex goes on a grid, which may repeat. Throws std::invalid_argument where the plane in which it turns is
/// not in the grid.
MovingFrame frameOf(const VortexTags& tags, const grid::Level& level);

/// What the problems of all vortices have in common, from the tags of S.
template <class Problem, class S>
Problem vortexProblem(const S& read, const grid::Level& level) {
  Problem problem;
  problem.density = read.density;
  problem.pressure = read.pressure;
  problem.gamma = read.gamma;
  problem.radius = read.radius;
  problem.axis = read.axis;
  problem.frame = frameOf(read, level);
  return problem;
}

/// 1 along the axes of the grid, 0 along those left out.
Vec3 axesOf(const grid::Level& level);

}  // namespace tushar::reference
