#include "components/mpm/mpm.hpp"

#include <algorithm>
#include <array>

#include "components/mpm/boundary_labels.hpp"
#include "core/simulation/by_dimension.hpp"
#include "core/simulation/module.hpp"

namespace tushar::mpm {

namespace {

constexpr std::array modules{"mpm_gas", "mpm_solid", "mpm_implicit"};

MethodKind& entryOf(Method method) {
  static std::array<MethodKind, modules.size()> entries;
  return entries[static_cast<std::size_t>(method)];
}

/// Returns the description of a method; loads the module of the method if necessary.
const MethodKind& kindOf(Method method) {
  simulation::loadModule(modules[static_cast<std::size_t>(method)]);
  return entryOf(method);
}

}  // namespace

Method methodOf(const input::Element& root) {
  const auto mpm = root.child("MPM");
  if (mpm && (mpm->child("gas_dynamics") || mpm->child("conserving_gas_dynamics"))) return Method::gas;
  const auto integrator = mpm ? mpm->child("time_integrator") : std::nullopt;
  return integrator && integrator->text() == "implicit" ? Method::implicitSolid : Method::solid;
}

void define(Method method, MethodKind kind) { entryOf(method) = std::move(kind); }

namespace {

/// The number of materials of a scene; 1 if it has none, which the method reports.
int countMaterials(const input::Element& root) {
  const auto properties = root.child("MaterialProperties");
  const auto mpm = properties ? properties->child("MPM") : std::nullopt;
  return mpm ? std::max(1, static_cast<int>(mpm->children("material").size())) : 1;
}

}  // namespace

simulation::ComponentKind kind() {
  simulation::ComponentKind kind;
  kind.name = "mpm";
  kind.sentence = "the Material Point Method: solids, and gas dynamics of Tran, Kim & Berzins";
  kind.sections = {"MPM", "MaterialProperties", "PhysicalConstants", "PhysicalBC"};
  kind.boundaryLabels = {grid::symmetric, boundary::velocity.evenOnPlanes(), boundary::temperature.evenOnPlanes()};
  kind.describe = [](std::ostream& out) {
    kindOf(Method::solid).describe(out);
    out << "Where <MPM> has <gas_dynamics> or <conserving_gas_dynamics>, instead:\n";
    kindOf(Method::gas).describe(out);
  };
  kind.forms = [] {
    std::vector<std::vector<simulation::SectionForm>> all = kindOf(Method::gas).forms();
    all.push_back(kindOf(Method::solid).forms().front());
    all.push_back(kindOf(Method::implicitSolid).forms().front());
    all.back().front().demands = {{"time_integrator", {"implicit"}}};
    return all;
  };
  kind.takesLevels = true;
  kind.refinesByItself = true;
  kind.nodesBeyond = [](const input::Element& root) {
    const auto& nodesBeyond = kindOf(methodOf(root)).nodesBeyond;
    return nodesBeyond ? nodesBeyond(root) : 0;
  };
  kind.read = [](const input::Element& root, input::Diagnostics& diagnostics) {
    simulation::refuseOtherMaterials(root, countMaterials(root), diagnostics);
    return kindOf(methodOf(root)).read(root, diagnostics);
  };
  return kind;
}

}  // namespace tushar::mpm
