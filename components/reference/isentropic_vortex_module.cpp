#include "components/reference/gas_module.hpp"
#include "components/reference/isentropic_vortex.hpp"
#include "components/reference/modules.hpp"

namespace tushar::reference {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::AnalysisKind;

namespace {

struct VortexSection : VortexTags {
  double density = 1, pressure = 1, strength = 5, radius = 1;
};
const Schema<VortexSection>& vortexSchema() {
  static const Schema<VortexSection> schema = [] {
    Schema<VortexSection> declared("Module", "Errors against a smooth vortex that a uniform flow carries along (Shu).");
    declareVortexTags(declared, "isentropicVortex");
    declared.value("density", &VortexSection::density, 1, "kg/m^3", "density far away", input::positive())
        .ours()
        .value("pressure", &VortexSection::pressure, 1, "Pa", "pressure far away", input::positive())
        .ours()
        .value("strength", &VortexSection::strength, 5, "m/s", "beta: 2 pi times the greatest speed around the centre")
        .ours()
        .value("radius", &VortexSection::radius, 1, "m", "where that speed is reached", input::positive())
        .ours();
    return declared;
  }();
  return schema;
}

}  // namespace

AnalysisKind isentropicVortexKind() {
  AnalysisKind kind{"isentropicVortex", "errors against a smooth vortex in a uniform flow", {}, {}};
  kind.describe = [](std::ostream& out) { vortexSchema().describe(out); };
  kind.schema = [] { return &vortexSchema(); };
  kind.read = [](const Element& module, Diagnostics& diagnostics) {
    return readModule(vortexSchema(), module, diagnostics, [](const VortexSection& read, const grid::Level& level) {
      IsentropicVortexProblem problem;
      problem.density = read.density;
      problem.pressure = read.pressure;
      problem.gamma = read.gamma;
      problem.strength = read.strength;
      problem.radius = read.radius;
      problem.axis = read.axis;
      problem.frame = frameOf(read, level);
      return std::make_shared<IsentropicVortex>(problem);
    });
  };
  return kind;
}

}  // namespace tushar::reference
