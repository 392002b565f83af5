#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "components/reference/moving_frame.hpp"
#include "components/reference/within.hpp"
#include "core/grid/level.hpp"
#include "core/input/schema.hpp"

namespace tushar::reference {

/// The tags that are common to all modules that measure a gas.
struct GasTags {
  std::string name;
  double gamma = 1.4;
  double pInfinity = 0;  ///< p_inf of a stiffened gas [Pa]
  std::optional<Region> within;
};

/// The schema of the tag `within`, a box in which errors are measured.
const input::Schema<Region>& regionSchema();

using input::memberOf;

/// The schema of the module `name` with the tags of GasTags, from which S is derived.
template <class S>
input::Schema<S> gasSchema(const std::string& name, std::string_view sentence, double gamma = 1.4) {
  return input::Schema<S>("Module", sentence)
      .requiredAttribute("name", memberOf<S>(&GasTags::name), "1", name)
      .value("gamma", memberOf<S>(&GasTags::gamma), gamma, "1", "ratio of specific heats", input::greaterThan(1))
      .ours()
      .section("within", memberOf<S>(&GasTags::within), regionSchema())
      .ours();
}

/// The tags that are common to the modules of vortices.
struct VortexTags : GasTags {
  int axis = 2;
  Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();
};

/// The schema of the module `name` with the tags of VortexTags, from which S is derived.
template <class S>
input::Schema<S> vortexSchema(const std::string& name, std::string_view sentence) {
  return gasSchema<S>(name, sentence)
      .required("centre", memberOf<S>(&VortexTags::centre), "m", "centre of the vortex at t = 0")
      .ours()
      .value("velocity", memberOf<S>(&VortexTags::velocity), Vec3::Zero(), "m/s",
             "velocity of the flow in which the vortex moves")
      .ours()
      .template choice<int>("axis", memberOf<S>(&VortexTags::axis), {{"x", 0}, {"y", 1}, {"z", 2}}, 2,
                            "the axis of rotation")
      .ours();
}

/// The tags that are common to the modules of flows around a centre.
struct RadialTags : GasTags {
  double density = 1, pressure = 0;
  Vec3 centre = Vec3::Zero();
};

/// The schema of the module `name` with the tags of RadialTags, from which S is derived. `centre` is the description of
/// the centre.
template <class S>
input::Schema<S> radialSchema(const std::string& name, std::string_view sentence, const std::string& centre,
                              double gamma = 1.4) {
  return gasSchema<S>(name, sentence, gamma)
      .value("density", memberOf<S>(&RadialTags::density), 1, "kg/m^3", "density at t = 0", input::positive())
      .ours()
      .value("pressure", memberOf<S>(&RadialTags::pressure), 0, "Pa", "pressure at t = 0, which should be almost 0",
             input::nonNegative())
      .ours()
      .value("centre", memberOf<S>(&RadialTags::centre), Vec3::Zero(), "m", centre)
      .ours();
}

/// The path of the vortex on a grid, which may be periodic. Throws std::invalid_argument if the grid does not use both
/// axes of the plane in which the vortex turns.
MovingFrame frameOf(const VortexTags& tags, const grid::Level& level);

/// Makes the problem of a vortex, with the settings that all vortices have in common, from the tags of S.
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

/// 1 along the axes that the grid uses, 0 along the others.
Vec3 axesOf(const grid::Level& level);

}  // namespace tushar::reference
