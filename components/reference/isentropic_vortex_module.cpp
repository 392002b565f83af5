#include "components/reference/gas_module.hpp"
#include "components/reference/isentropic_vortex.hpp"
#include "components/reference/modules.hpp"

namespace tushar::reference {

namespace {

struct VortexSection : VortexTags {
  double density = 1, pressure = 1, strength = 5, radius = 1;
};
const input::Schema<VortexSection>& isentropicSchema() {
  static const input::Schema<VortexSection> schema =
      vortexSchema<VortexSection>("isentropicVortex", "Errors relative to a smooth vortex in a uniform flow (Shu).")
          .value("density", &VortexSection::density, 1, "kg/m^3", "density far away", input::positive())
          .ours()
          .value("pressure", &VortexSection::pressure, 1, "Pa", "pressure far away", input::positive())
          .ours()
          .value("strength", &VortexSection::strength, 5, "m/s", "beta: 2 pi times the largest speed around the centre")
          .ours()
          .value("radius", &VortexSection::radius, 1, "m", "radius at which that speed is reached", input::positive())
          .ours();
  return schema;
}

}  // namespace

simulation::AnalysisKind isentropicVortexKind() {
  return gasModule("isentropicVortex", "errors relative to a smooth vortex in a uniform flow", isentropicSchema,
                   [](const VortexSection& read, const grid::Level& level) {
                     auto problem = vortexProblem<IsentropicVortexProblem>(read, level);
                     problem.strength = read.strength;
                     return std::make_shared<IsentropicVortex>(problem);
                   });
}

}  // namespace tushar::reference
