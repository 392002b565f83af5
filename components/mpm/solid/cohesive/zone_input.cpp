#include "components/mpm/solid/cohesive/zone_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "components/mpm/solid/cohesive/zone_file.hpp"
#include "components/mpm/solid/problem.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

/// A zone fails beyond this multiple of the length at which its traction has its maximum, unless the scene gives a
/// length; as in Uintah.
constexpr double lengthsToFailure = 4;

CohesiveLaw lawOf(const ZonesTag& tag) {
  return {.normalStrength = tag.normalStrength,
          .tangentialStrength = tag.tangentialStrength,
          .normalLength = tag.normalLength,
          .tangentialLength = tag.tangentialLength,
          .normalFailureLength = tag.normalFailureLength.value_or(lengthsToFailure * tag.normalLength),
          .tangentialFailureLength = tag.tangentialFailureLength.value_or(lengthsToFailure * tag.tangentialLength)};
}

/// Gives each set of zones a name that no material has.
void nameZones(std::vector<CohesiveZones>& sets, const std::vector<Material>& materials) {
  std::set<std::string> names;
  for (const Material& material : materials) names.insert(material.name);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    if (sets[k].name.empty()) sets[k].name = "cohesive_zones";
    if (!names.insert(sets[k].name).second) names.insert(sets[k].name += "." + std::to_string(materials.size() + k));
  }
}

/// Refuses parts of a scene with which zones are not available.
void refuseBeside(const Problem& problem, const ZoneSwitches& switches, const Element& tag, Diagnostics& diagnostics) {
  if (switches.besideGas) diagnostics.error(tag, "is not available with a gas");
  if (switches.isAxisymmetric) diagnostics.error(tag, "is not available with <axisymmetric>");
  if (problem.method.isGranular) diagnostics.error(tag, "is not available with <DoGranularMPM>");
}

bool isIn(const Material& material, const Vec3& point) {
  return std::any_of(material.bodies.begin(), material.bodies.end(),
                     [&](const Body& body) { return !body.seeds && body.shape->contains(point); });
}

/// Whether a zone lies on the grid, also along axes that the grid does not use.
template <int D>
bool isOnGrid(const Level& level, const Problem& problem, const CohesiveZone& zone) {
  for (int axis = 0; axis < 3; ++axis) {
    const double at = zone.position[axis];
    const bool isOutside = at < level.domain().lower[axis] || at > level.domain().upper[axis];
    if (problem.method.isThin[axis] && level.cellWidth(axis) > 0 && isOutside) return false;
  }
  return level.isInside<D>(level.cellOf<D>(level.reduce<D>(zone.position)));
}

/// Whether the bottom body lies on the side to which the normal points, and the top body on the other one.
bool isReversed(const Level& level, const Problem& problem, const CohesiveZone& zone) {
  const Vec3 above = zone.position + 0.5 * level.minSpacing() * zone.normal, below = 2 * zone.position - above;
  const Material &bottom = problem.materials[zone.bottom], &top = problem.materials[zone.top];
  return isIn(bottom, above) && isIn(top, below) && !isIn(top, above) && !isIn(bottom, below);
}

/// Exchanges both bodies of zones whose normals point from the top to the bottom body; returns the number of these
/// zones.
std::size_t turn(const Level& level, const Problem& problem, CohesiveZones& set) {
  std::size_t count = 0;
  for (CohesiveZone& zone : set.zones) {
    if (!isReversed(level, problem, zone)) continue;
    std::swap(zone.bottom, zone.top);
    ++count;
  }
  return count;
}

void refuseOutOfPlane(const Problem& problem, const CohesiveZones& set) {
  for (const CohesiveZone& zone : set.zones)
    for (int axis = 0; axis < 3; ++axis)
      if (problem.method.isThin[axis] && std::abs(zone.normal[axis]) > 1e-9)
        throw InputError(
            {{{set.file, zone.line, 0},
              "",
              fmt::format("the normal has a component along {}, along which the grid has one cell", "xyz"[axis])}});
}

template <int D>
void placeZonesIn(const Level& level, Problem& problem) {
  const std::string tag = "MaterialProperties/MPM/cohesive_zone";
  for (CohesiveZones& set : problem.zones) {
    refuseOutOfPlane(problem, set);
    const std::size_t all = set.zones.size();
    const std::size_t outside =
        std::erase_if(set.zones, [&](const CohesiveZone& zone) { return !isOnGrid<D>(level, problem, zone); });
    if (outside > 0)
      problem.notes.push_back(
          {set.where, tag, fmt::format("{} of {} zones are outside the grid and left out", outside, all)});
    const std::size_t reversed = turn(level, problem, set);
    if (reversed > 0)
      problem.notes.push_back(
          {set.where, tag,
           fmt::format("the normals of {} zones point from the top material to the bottom material, so the two "
                       "materials of these zones are exchanged; in Uintah, their opening counts as compression",
                       reversed)});
  }
}

/// The tags of a law.
void addLaw(Schema<ZonesTag>& tags) {
  tags.required("sig_max", &ZonesTag::normalStrength, "Pa", "largest traction in mode I", input::positive())
      .required("tau_max", &ZonesTag::tangentialStrength, "Pa", "largest traction in mode II", input::positive())
      .required("delta_n", &ZonesTag::normalLength, "m", "opening at which the traction is sig_max", input::positive())
      .required("delta_t", &ZonesTag::tangentialLength, "m",
                "length of the law in mode II: the traction is tau_max where a zone has slid by delta_t / 2^(1/2)",
                input::positive())
      .optional("delta_n_fail", &ZonesTag::normalFailureLength, "m",
                "a zone fails if it opens, or is compressed, by more than this; 4 delta_n by default",
                input::positive())
      .optional("delta_t_fail", &ZonesTag::tangentialFailureLength, "m",
                "a zone fails if it slides by more than this; 4 delta_t by default", input::positive());
}

}  // namespace

const Schema<ZonesTag>& zonesSchema() {
  static const Schema<ZonesTag> schema = [] {
    Schema<ZonesTag> tags(
        "cohesive_zone",
        "Cohesive zones between bodies, for <use_cohesive_zones>: a law for the traction across them, "
        "and a file with their places.");
    tags.attributeValue("name", &ZonesTag::name, "", "1", "name; cohesive_zones by default").location(&ZonesTag::where);
    addLaw(tags);
    tags.required("cz_filename", &ZonesTag::file, "1",
                  "a file next to the scene, with 12 numbers per line: position (x, y, z, m), area (m^2), unit normal "
                  "(from the bottom to the top material), a tangent, and the indices of the bottom and the top "
                  "material");
    refuseSwitch(tags, "do_rotation", "zones keep their normals");
    return tags;
  }();
  return schema;
}

void settleZones(Problem& problem, const std::vector<ZonesTag>& tags, const ZoneSwitches& switches, const Element& root,
                 Diagnostics& diagnostics) {
  const Element mpm = root.child("MPM").value_or(root);
  if (!switches.usesZones) {
    if (!tags.empty())
      diagnostics.note(root.child("MaterialProperties")->child("MPM")->child("cohesive_zone").value(),
                       "does nothing without <use_cohesive_zones> true");
    return;
  }
  const Element named = mpm.child("use_cohesive_zones").value_or(mpm);
  refuseBeside(problem, switches, named, diagnostics);
  if (tags.empty())
    diagnostics.error(root.child("MaterialProperties")->child("MPM").value(),
                      "missing tag <cohesive_zone> in <MPM>: needed with <use_cohesive_zones>");
  for (const ZonesTag& tag : tags) {
    const std::string path = (std::filesystem::path(tag.where.file).parent_path() / tag.file).string();
    problem.zones.push_back({tag.name, lawOf(tag), path, tag.where,
                             readZones(path, tag.where, static_cast<int>(problem.materials.size()), diagnostics)});
  }
  nameZones(problem.zones, problem.materials);
}

void placeZones(const Level& level, Problem& problem) {
  if (level.dimension() == 1) return placeZonesIn<1>(level, problem);
  level.dimension() == 2 ? placeZonesIn<2>(level, problem) : placeZonesIn<3>(level, problem);
}

}  // namespace tushar::mpm::solid
