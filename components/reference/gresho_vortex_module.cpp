#include "components/reference/gas_module.hpp"
#include "components/reference/gresho_vortex.hpp"
#include "components/reference/modules.hpp"

namespace tushar::reference {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::AnalysisKind;

namespace {

struct GreshoSection : VortexTags {
  double density = 1, pressure = 5, speed = 1, radius = 0.2;
};
const Schema<GreshoSection>& greshoSchema() {
  static const Schema<GreshoSection> schema = [] {
    Schema<GreshoSection> declared("Module",
                                   "Errors against the vortex of Gresho: two rings, at rest or carried along.");
    declareVortexTags(declared, "gresho");
    declared.value("density", &GreshoSection::density, 1, "kg/m^3", "density everywhere", input::positive())
        .ours()
        .value("pressure", &GreshoSection::pressure, 5, "Pa", "pressure in the middle", input::positive())
        .ours()
        .value("speed", &GreshoSection::speed, 1, "m/s", "the greatest speed around the centre")
        .ours()
        .value("radius", &GreshoSection::radius, 0.2, "m",
               "where that speed is reached; beyond twice of it nothing turns", input::positive())
        .ours();
    return declared;
  }();
  return schema;
}

}  // namespace

AnalysisKind greshoKind() {
  AnalysisKind kind{"gresho", "errors against the vortex of Gresho", {}, {}};
  kind.describe = [](std::ostream& out) { greshoSchema().describe(out); };
  kind.schema = [] { return &greshoSchema(); };
  kind.read = [](const Element& module, Diagnostics& diagnostics) {
    return readModule(greshoSchema(), module, diagnostics, [](const GreshoSection& read, const grid::Level& level) {
      GreshoProblem problem;
      problem.density = read.density;
      problem.pressure = read.pressure;
      problem.gamma = read.gamma;
      problem.speed = read.speed;
      problem.radius = read.radius;
      problem.axis = read.axis;
      problem.frame = frameOf(read, level);
      return std::make_shared<GreshoVortex>(problem);
    });
  };
  return kind;
}

}  // namespace tushar::reference
