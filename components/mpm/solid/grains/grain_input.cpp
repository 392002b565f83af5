#include "components/mpm/solid/grains/grain_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "components/mpm/particles/ids.hpp"
#include "core/input/text.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

constexpr std::array grainTags{"critical_density", "stress_free", "MatTypeIdx", "applied_contact_model",
                               "allow_DWIndex_correction"};

std::vector<Element> materialTags(const Element& root) {
  return root.child("MaterialProperties")->child("MPM")->children("material");
}

/// The contents of a tag as one line; equal numbers, such as 0.0 and 0.00, give equal lines.
std::string contentsOf(const Element& tag) {
  std::string text = tag.name();
  for (const input::Attribute& attribute : tag.attributes()) text += " " + attribute.name + "=" + attribute.value;
  const auto number = input::parse<double>(tag.text()).value;
  text += ">" + (number ? fmt::format("{}", *number) : tag.text());
  for (const Element& child : tag.children()) text += contentsOf(child);
  return text + "<";
}

/// What materials that exchange particles must have in common, as one line.
std::string commonContentsOf(const Element& material) {
  std::string text;
  for (const char* name : {"constitutive_model", "damage_model", "erosion", "density", "specific_heat",
                           "thermal_conductivity", "melt_temp", "room_temp", "linear_thermal_expansion_coef",
                           "is_rigid", "stress_free", "possible_alpha_material"})
    if (const auto tag = material.child(name)) text += contentsOf(*tag);
  return text;
}

/// Refuses tags that are missing or out of range.
void checkGrain(const Material& material, const Element& tag, Diagnostics& diagnostics) {
  for (const auto& [name, isGiven] : {std::pair{"critical_density", material.criticalDensity.has_value()},
                                      std::pair{"MatTypeIdx", material.grainType.has_value()}})
    if (!isGiven)
      diagnostics.error(tag, fmt::format("missing tag <{}> in <material>: needed with <DoGranularMPM>", name));
  if (material.criticalDensity.value_or(0) > material.density)
    diagnostics.error(tag.child("critical_density").value(),
                      fmt::format("found {:g}, expected at most the <density>, {:g}: otherwise the particles of a body "
                                  "do not touch at the start",
                                  *material.criticalDensity, material.density));
}

/// Refuses materials of one type that differ.
void checkTypes(const Problem& problem, const std::vector<Element>& tags, Diagnostics& diagnostics) {
  std::map<int, std::size_t> firstOfType, firstWithBodies;
  for (std::size_t m = 0; m < tags.size(); ++m) {
    const Material& material = problem.materials[m];
    if (!material.grainType) continue;
    const std::size_t first = firstOfType.try_emplace(*material.grainType, m).first->second;
    if (first != m && commonContentsOf(tags[m]) != commonContentsOf(tags[first]))
      diagnostics.error(tags[m],
                        fmt::format("has the MatTypeIdx of '{}', but another density, constitutive model or other "
                                    "constant: materials that exchange particles must be equal",
                                    problem.materials[first].name));
    if (material.bodies.empty()) continue;
    const std::size_t other = firstWithBodies.try_emplace(*material.grainType, m).first->second;
    if (material.maySplit != problem.materials[other].maySplit)
      diagnostics.error(tags[m], fmt::format("allow_DWIndex_correction: differs from that of '{}', which has the same "
                                             "MatTypeIdx and also has bodies",
                                             problem.materials[other].name));
  }
}

/// Refuses what is not available when particles change their material.
void refuseBeside(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  const Element mpm = root.child("MPM").value();
  const auto refuse = [&](const char* tag, bool isGiven) {
    if (isGiven) diagnostics.error(mpm.child(tag).value_or(mpm), "is not available with <DoGranularMPM>");
  };
  refuse("axisymmetric", problem.start.axisymmetric);
  refuse("InsertParticles", !problem.insertions.empty());
  refuse("UsePrescribedDeformation", problem.motion != nullptr);
  refuse("RunMMSProblem", problem.start.solution != nullptr);
  if (problem.method.thermalContact)
    diagnostics.error(root.child("MaterialProperties")->child("MPM")->child("thermal_contact").value(),
                      "is not available with <DoGranularMPM>");
  const auto tags = materialTags(root);
  for (std::size_t m = 0; m < tags.size(); ++m)
    if (problem.materials[m].transmitsForce)
      diagnostics.error(tags[m].child("is_force_transmitting_material").value(),
                        "is not available with <DoGranularMPM>");
  for (const Contact& contact : problem.contacts)
    if ((contact.hasMaster() || !contact.frictionOfColor.empty()) && problem.materials[contact.master].maySplit)
      diagnostics.error(tags[contact.master].child("allow_DWIndex_correction").value(),
                        "must be false for the master of a <contact>");
}

/// Gives the particles of materials that may exchange particles different ids.
void separateIds(std::vector<Material>& materials) {
  std::map<int, ParticleId> count, next;
  for (const Material& material : materials)
    if (!material.bodies.empty()) ++count[*material.grainType];
  for (Material& material : materials)
    if (!material.bodies.empty())
      material.firstIdInCell = next[*material.grainType]++ * (idsOfCell / count[*material.grainType]);
}

/// Refuses materials without bodies, and notes that tags of grains have no effect.
void forgetGrains(std::vector<Material>& materials, const std::vector<Element>& tags, Diagnostics& diagnostics) {
  for (std::size_t m = 0; m < tags.size(); ++m) {
    materials[m].isStressFree = materials[m].maySplit = false;
    if (materials[m].bodies.empty())
      diagnostics.error(tags[m], "missing tag <geom_object> in <material> (a body of material at the start)");
  }
  for (const Element& tag : tags)
    for (const char* name : grainTags)
      if (const auto given = tag.child(name)) return diagnostics.note(*given, "does nothing without <DoGranularMPM>");
}

}  // namespace

void addGrainTags(Schema<Material>& material) {
  material
      .optional("critical_density", &Material::criticalDensity, "kg/m^3",
                "with <DoGranularMPM>: the density at which particles just touch", input::positive())
      .value(
          "stress_free", &Material::isStressFree, false, "1",
          "with <DoGranularMPM>: F and the volume of a particle do not change in a step that would bring its density "
          "below the critical one")
      .optional("MatTypeIdx", &Material::grainType, "1",
                "with <DoGranularMPM>: materials with the same number exchange particles", input::nonNegative())
      .value("applied_contact_model", &Material::hasGrainContact, true, "1",
             "with <DoGranularMPM>: true: the material is for clusters that touch particles with another MatTypeIdx; "
             "false: it is for clusters that do not")
      .value("allow_DWIndex_correction", &Material::maySplit, false, "1",
             "with <DoGranularMPM>: whether its particles move to other materials with the same MatTypeIdx when they "
             "separate");
}

void settleGrains(Problem& problem, const GrainSwitches& switches, const Element& root, Diagnostics& diagnostics) {
  const std::vector<Element> tags = materialTags(root);
  problem.method.isGranular = switches.isGranular;
  if (!switches.isGranular) return forgetGrains(problem.materials, tags, diagnostics);
  const std::size_t before = diagnostics.size();
  for (std::size_t m = 0; m < tags.size(); ++m) checkGrain(problem.materials[m], tags[m], diagnostics);
  checkTypes(problem, tags, diagnostics);
  if (switches.besideGas)
    diagnostics.error(root.child("MPM")->child("DoGranularMPM").value(), "is not available with a gas");
  refuseBeside(problem, root, diagnostics);
  if (diagnostics.size() == before) separateIds(problem.materials);
}

}  // namespace tushar::mpm::solid
