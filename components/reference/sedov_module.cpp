#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/sedov.hpp"

namespace tushar::reference {

namespace {

struct SedovSection : RadialTags {
  double energy = 1;
};
const input::Schema<SedovSection>& sedovSchema() {
  static const input::Schema<SedovSection> schema =
      radialSchema<SedovSection>(
          "sedov",
          "Errors relative to Sedov's self-similar blast wave from a plane, a line or a point, if "
          "the grid has 1, 2 or 3 dimensions. Internal energy is a mass-weighted mean.",
          "point at which the energy is released")
          .required("energy", &SedovSection::energy, "J, J/m or J/m^2",
                    "energy released in the whole space, even if the grid covers only a part; per metre for a line, "
                    "per square metre for a plane",
                    input::positive())
          .ours();
  return schema;
}

}  // namespace

simulation::AnalysisKind sedovKind() {
  return gasModule("sedov", "errors relative to Sedov's self-similar blast wave", sedovSchema,
                   [](const SedovSection& read, const grid::Level& level) {
                     return std::make_shared<Sedov>(SedovProblem{read.density, read.pressure, read.energy, read.gamma,
                                                                 read.centre, axesOf(level)});
                   });
}

}  // namespace tushar::reference
