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
      radialSchema<SedovSection>("sedov",
                                 "Errors against the self-similar blast wave of Sedov from a plane, a line or a point, "
                                 "as the grid has 1, 2 or 3 dimensions. Internal energy is a mean by mass.",
                                 "where the energy is set free")
          .required(
              "energy", &SedovSection::energy, "J, J/m or J/m^2",
              "set free in the whole of space, whatever part of it the grid holds; per metre of a line, per square "
              "metre of a plane",
              input::positive())
          .ours();
  return schema;
}

}  // namespace

simulation::AnalysisKind sedovKind() {
  return gasModule("sedov", "errors against the self-similar blast wave of Sedov", sedovSchema,
                   [](const SedovSection& read, const grid::Level& level) {
                     return std::make_shared<Sedov>(SedovProblem{read.density, read.pressure, read.energy, read.gamma,
                                                                 read.centre, axesOf(level)});
                   });
}

}  // namespace tushar::reference
