#include "components/reference/gas_module.hpp"
#include "components/reference/gresho_vortex.hpp"
#include "components/reference/modules.hpp"

namespace tushar::reference {

namespace {

struct GreshoSection : VortexTags {
  double density = 1, pressure = 5, speed = 1, radius = 0.2;
};
const input::Schema<GreshoSection>& greshoSchema() {
  static const input::Schema<GreshoSection> schema =
      vortexSchema<GreshoSection>("gresho", "Errors relative to the Gresho vortex, at rest or in a uniform flow.")
          .value("density", &GreshoSection::density, 1, "kg/m^3", "density everywhere", input::positive())
          .ours()
          .value("pressure", &GreshoSection::pressure, 5, "Pa", "pressure at the centre", input::positive())
          .ours()
          .value("speed", &GreshoSection::speed, 1, "m/s", "largest speed around the centre")
          .ours()
          .value("radius", &GreshoSection::radius, 0.2, "m",
                 "radius at which that speed is reached; beyond twice that radius the gas does not rotate",
                 input::positive())
          .ours();
  return schema;
}

}  // namespace

simulation::AnalysisKind greshoKind() {
  return gasModule("gresho", "errors relative to the Gresho vortex", greshoSchema,
                   [](const GreshoSection& read, const grid::Level& level) {
                     auto problem = vortexProblem<GreshoProblem>(read, level);
                     problem.speed = read.speed;
                     return std::make_shared<GreshoVortex>(problem);
                   });
}

}  // namespace tushar::reference
