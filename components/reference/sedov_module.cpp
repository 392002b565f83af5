#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/sedov.hpp"

namespace tushar::reference {

namespace {

struct SedovSection : GasTags {
  double density = 1, pressure = 0, energy = 1;
  Vec3 centre = Vec3::Zero();
};
const input::Schema<SedovSection>& sedovSchema() {
  static const input::Schema<SedovSection> schema =
      gasSchema<SedovSection>("sedov",
                              "Errors against the self-similar blast wave of Sedov from a plane, a line or a point, as "
                              "the grid has 1, 2 or 3 dimensions. Internal energy is a mean by mass.")
          .required(
              "energy", &SedovSection::energy, "J, J/m or J/m^2",
              "set free in the whole of space, whatever part of it the grid holds; per metre of a line, per square "
              "metre of a plane",
              input::positive())
          .ours()
          .value("density", &SedovSection::density, 1, "kg/m^3", "density at t = 0", input::positive())
          .ours()
          .value("pressure", &SedovSection::pressure, 0, "Pa",
                 "pressure ahead of the shock, which should be next to nothing", input::nonNegative())
          .ours()
          .value("centre", &SedovSection::centre, Vec3::Zero(), "m", "where the energy is set free")
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
