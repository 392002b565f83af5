#include "components/mpm/gas/input.hpp"

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/gas/conserving/input.hpp"
#include "components/mpm/gas/material_input.hpp"
#include "components/mpm/gas/paper/gas_mpm.hpp"
#include "components/mpm/gas/paper/input.hpp"
#include "core/simulation/by_dimension.hpp"
#include "core/simulation/module.hpp"

namespace tushar::mpm::gas {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

struct MpmSection {
  int integrator = 0, interpolator = 0;
  std::optional<paper::GasDynamics> gas;
  std::optional<conserving::Section> conserving;
};
const Schema<MpmSection>& mpmSchema() {
  static const Schema<MpmSection> schema =
      Schema<MpmSection>("MPM", "The Material Point Method.")
          .choice("time_integrator", &MpmSection::integrator, {{"explicit", 0}}, 0, "the time integrator")
          .choice("interpolator", &MpmSection::interpolator, {{"linear", 0}}, 0, "shape functions")
          .section("gas_dynamics", &MpmSection::gas, paper::methodSchema())
          .ours()
          .section("conserving_gas_dynamics", &MpmSection::conserving, conserving::sectionSchema())
          .ours()
          .check([](const MpmSection& mpm, const Element& element, Diagnostics& diagnostics) {
            if (mpm.gas.has_value() == mpm.conserving.has_value())
              diagnostics.error(element, std::string(mpm.gas ? "gives both" : "gives neither") +
                                             " <gas_dynamics> and <conserving_gas_dynamics>; keep one");
          });
  return schema;
}

/// Refuses placements other than midpoint, because the particles of the conserving method must tile their cells.
void refusePlacements(const GasProperties& properties, Diagnostics& diagnostics) {
  for (const GasSection& material : properties.mpm.materials)
    for (const GasObjectSection& object : material.objects)
      if (object.placement != Placement::midpoint)
        diagnostics.error(object.where, "MaterialProperties/MPM/material/geom_object",
                          "placement: the boxes of <conserving_gas_dynamics> must fill the gas without gaps; use "
                          "midpoint, or <gas_dynamics>");
}

/// Refuses several gases unless the settings support them: <conserving_gas_dynamics> with `apic`, without <remap>,
/// <artificial_heat_conduction> and <relaxation>. Also refuses two gases of the same name.
void refuseMixtures(const MpmSection& method, const GasProperties& properties, Diagnostics& diagnostics) {
  const std::vector<GasSection>& materials = properties.mpm.materials;
  if (materials.size() < 2) return;
  const auto refuse = [&](const std::string& why) {
    diagnostics.error(materials[1].model.where, "MaterialProperties/MPM/material", why);
  };
  if (method.gas)
    refuse("<gas_dynamics> allows one material; give it several <geom_object>s, or use <conserving_gas_dynamics>");
  if (!method.conserving) return;
  if (method.conserving->transfer != conserving::Transfer::apic) refuse("several gases need <transfer> apic");
  if (method.conserving->remap) refuse("several gases cannot have a <remap>; remove it");
  if (method.conserving->heatConduction > 0) refuse("several gases cannot have <artificial_heat_conduction>");
  for (std::size_t k = 0; k < materials.size(); ++k) {
    if (materials[k].relaxation) refuse("several gases cannot have <relaxation>");
    for (std::size_t other = 0; other < k; ++other)
      if (materials[k].name == materials[other].name)
        refuse("two materials are called '" + materials[k].name + "'; give each a different name");
  }
}

/// Refuses stiffened gases, because <gas_dynamics> is a method for ideal gases.
void refuseStiffness(const GasProperties& properties, Diagnostics& diagnostics) {
  for (const GasSection& material : properties.mpm.materials)
    if (material.model.type == GasType::stiffened)
      diagnostics.error(material.model.where, "MaterialProperties/MPM/material/constitutive_model",
                        "type: <gas_dynamics> takes only an ideal_gas; use <conserving_gas_dynamics>");
}

/// Refuses sections that only scenes of solids may have.
void refuseSolidsOnly(const Element& root, Diagnostics& diagnostics) {
  if (const auto constants = root.child("PhysicalConstants"))
    diagnostics.error(*constants, "a gas cannot have <PhysicalConstants>: only its pressure acts on it");
  if (const auto loads = root.child("PhysicalBC"))
    diagnostics.error(*loads, "a gas cannot have <PhysicalBC>: only the pressure at its sides acts on it");
  for (const Element& condition : simulation::boundaryConditions(root))
    if (const auto label = condition.attribute("label");
        label && (*label == boundary::velocity.name || *label == boundary::temperature.name))
      diagnostics.error(condition,
                        "label: found '" + *label + "', expected 'Symmetric', the only label available for a gas");
}

std::unique_ptr<Component> makeComponent(const Level& level, const MpmSection& method, const std::vector<Gas>& gases) {
  if (method.gas && method.gas->redistribute) paper::checkSeeds(*method.gas->redistribute, level.dimension());
  if (method.gas) return simulation::makeByDimension<paper::GasMpm>(level, *method.gas, gases);
  simulation::loadModule("mpm_gas_conserving");
  return conserving::makeConservingMpm(level, conserving::settle(*method.conserving, level.dimension()), gases);
}

/// Reads a scene with gases; reports every problem to the diagnostics.
simulation::MakeComponent readScene(const Element& root, Diagnostics& diagnostics) {
  refuseSolidsOnly(root, diagnostics);
  const std::size_t before = diagnostics.size();
  const MpmSection method = simulation::readSection(root, mpmSchema(), diagnostics);
  const GasProperties properties = simulation::readSection(root, gasProperties(), diagnostics);
  refuseMixtures(method, properties, diagnostics);
  method.conserving ? refusePlacements(properties, diagnostics) : refuseStiffness(properties, diagnostics);
  if (diagnostics.size() > before) return {};
  std::vector<Gas> gases;
  const std::vector<GasSection>& materials = properties.mpm.materials;
  for (const GasSection& material : materials) gases.push_back(makeGas(material, materials.size() == 1));
  return [method, gases](const Level& level) { return makeComponent(level, method, gases); };
}

/// The sections of a scene with gases, for the schemas of editors: one list of sections for each method.
std::vector<std::vector<simulation::SectionForm>> forms() {
  std::vector<std::vector<simulation::SectionForm>> forms;
  for (const char* method : {"gas_dynamics", "conserving_gas_dynamics"})
    forms.push_back({{"MPM", &mpmSchema(), true, {{method, {}}}}, {"MaterialProperties", &gasProperties()}});
  return forms;
}

void describe(std::ostream& out) {
  mpmSchema().describe(out);
  gasProperties().describe(out);
}

}  // namespace

MethodKind kind() { return {readScene, describe, forms}; }

}  // namespace tushar::mpm::gas
