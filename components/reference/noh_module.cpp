#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/noh.hpp"

namespace tushar::reference {

namespace {

struct NohSection : GasTags {
  double density = 1, speed = 1, pressure = 0;
  Vec3 centre = Vec3::Zero();
};
const input::Schema<NohSection>& nohSchema() {
  static const input::Schema<NohSection> schema =
      gasSchema<NohSection>("noh",
                            "Errors against Noh's problem: cold gas falls into a plane, a line or a point, "
                            "as the grid has 1, 2 or 3 dimensions.",
                            5.0 / 3)
          .value("density", &NohSection::density, 1, "kg/m^3", "density at t = 0", input::positive())
          .ours()
          .value("speed", &NohSection::speed, 1, "m/s", "of the gas towards the centre", input::positive())
          .ours()
          .value("pressure", &NohSection::pressure, 0, "Pa", "pressure at t = 0, which should be next to nothing",
                 input::nonNegative())
          .ours()
          .value("centre", &NohSection::centre, Vec3::Zero(), "m", "where the gas falls to")
          .ours();
  return schema;
}

}  // namespace

simulation::AnalysisKind nohKind() {
  return gasModule("noh", "errors against Noh's problem: cold gas that falls into a point", nohSchema,
                   [](const NohSection& read, const grid::Level& level) {
                     return std::make_shared<Noh>(
                         NohProblem{read.density, read.speed, read.pressure, read.gamma, read.centre, axesOf(level)});
                   });
}

}  // namespace tushar::reference
