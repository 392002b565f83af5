#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/noh.hpp"

namespace tushar::reference {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::AnalysisKind;

namespace {

struct NohSection : GasTags {
  double density = 1, speed = 1, pressure = 0;
  Vec3 centre = Vec3::Zero();
};
const Schema<NohSection>& nohSchema() {
  static const Schema<NohSection> schema = [] {
    Schema<NohSection> declared("Module",
                                "Errors against Noh's problem: cold gas falls into a plane, a line or a point, "
                                "as the grid has 1, 2 or 3 dimensions.");
    declareGasTags(declared, "noh", 5.0 / 3);
    declared.value("density", &NohSection::density, 1, "kg/m^3", "density at t = 0", input::positive())
        .ours()
        .value("speed", &NohSection::speed, 1, "m/s", "of the gas towards the centre", input::positive())
        .ours()
        .value("pressure", &NohSection::pressure, 0, "Pa", "pressure at t = 0, which should be next to nothing",
               input::nonNegative())
        .ours()
        .value("centre", &NohSection::centre, Vec3::Zero(), "m", "where the gas falls to")
        .ours();
    return declared;
  }();
  return schema;
}

}  // namespace

AnalysisKind nohKind() {
  AnalysisKind kind{"noh", "errors against Noh's problem: cold gas that falls into a point", {}, {}};
  kind.describe = [](std::ostream& out) { nohSchema().describe(out); };
  kind.schema = [] { return &nohSchema(); };
  kind.read = [](const Element& module, Diagnostics& diagnostics) {
    return readModule(nohSchema(), module, diagnostics, [](const NohSection& read, const grid::Level& level) {
      return std::make_shared<Noh>(
          NohProblem{read.density, read.speed, read.pressure, read.gamma, read.centre, axesOf(level)});
    });
  };
  return kind;
}

}  // namespace tushar::reference
