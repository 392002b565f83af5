#include "components/mpm/mpm.hpp"

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/gas/input.hpp"
#include "components/mpm/solid/explicit/input.hpp"
#include "components/mpm/solid/implicit/input.hpp"
#include "components/mpm/solid/scene_input.hpp"

namespace tushar::mpm {

simulation::ComponentKind kind() {
  simulation::ComponentKind kind;
  kind.name = "mpm";
  kind.sentence = "the Material Point Method: solids, and gas dynamics of Tran, Kim & Berzins";
  kind.sections = {"MPM", "MaterialProperties", "PhysicalConstants", "PhysicalBC"};
  kind.boundaryLabels = {grid::symmetric, boundary::velocity.evenOnPlanes(), boundary::temperature.evenOnPlanes()};
  kind.describe = [](std::ostream& out) {
    solid::describe(out);
    out << "Where <MPM> has <gas_dynamics> or <conserving_gas_dynamics>, instead:\n";
    gas::describe(out);
  };
  kind.forms = [] {
    std::vector<std::vector<simulation::SectionForm>> all = gas::forms();
    all.push_back(solid::forms());
    all.push_back(solid::implicit::forms());
    all.back().front().demands = {{"time_integrator", {"implicit"}}};
    return all;
  };
  kind.nodesBeyond = [](const input::Element& root) { return gas::isGas(root) ? 0 : solid::nodesBeyond(root); };
  kind.read = [](const input::Element& root, input::Diagnostics& diagnostics) {
    if (gas::isGas(root)) return gas::readScene(root, diagnostics);
    if (solid::implicit::isImplicit(root)) return solid::implicit::readScene(root, diagnostics);
    return solid::readScene(root, diagnostics);
  };
  return kind;
}

}  // namespace tushar::mpm
