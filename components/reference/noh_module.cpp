#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/noh.hpp"

namespace tushar::reference {

namespace {

struct NohSection : RadialTags {
  double speed = 1;
};
const input::Schema<NohSection>& nohSchema() {
  static const input::Schema<NohSection> schema =
      radialSchema<NohSection>(
          "noh",
          "Errors relative to Noh's problem: cold gas converges on a plane, a line or a point, if the "
          "grid has 1, 2 or 3 dimensions.",
          "point towards which the gas moves", 5.0 / 3)
          .value("speed", &NohSection::speed, 1, "m/s", "speed of the gas towards the centre", input::positive())
          .ours();
  return schema;
}

}  // namespace

simulation::AnalysisKind nohKind() {
  return gasModule("noh", "errors relative to Noh's problem: cold gas that converges on a point", nohSchema,
                   [](const NohSection& read, const grid::Level& level) {
                     return std::make_shared<Noh>(
                         NohProblem{read.density, read.speed, read.pressure, read.gamma, read.centre, axesOf(level)});
                   });
}

}  // namespace tushar::reference
