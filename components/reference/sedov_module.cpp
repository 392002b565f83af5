#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/sedov.hpp"

namespace tushar::reference {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::AnalysisKind;

namespace {

struct SedovSection : GasTags {
  double density = 1, pressure = 0, energy = 1;
  Vec3 centre = Vec3::Zero();
};
const Schema<SedovSection>& sedovSchema() {
  static const Schema<SedovSection> schema = [] {
    Schema<SedovSection> declared(
        "Module",
        "Errors against the self-similar blast wave of Sedov from a plane, a line or a point, as "
        "the grid has 1, 2 or 3 dimensions. Internal energy is a mean by mass.");
    declareGasTags(declared, "sedov");
    declared
        .required("energy", &SedovSection::energy, "J, J/m or J/m^2",
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
    return declared;
  }();
  return schema;
}

}  // namespace

AnalysisKind sedovKind() {
  AnalysisKind kind{"sedov", "errors against the self-similar blast wave of Sedov", {}, {}};
  kind.describe = [](std::ostream& out) { sedovSchema().describe(out); };
  kind.schema = [] { return &sedovSchema(); };
  kind.read = [](const Element& module, Diagnostics& diagnostics) {
    return readModule(sedovSchema(), module, diagnostics, [](const SedovSection& read, const grid::Level& level) {
      return std::make_shared<Sedov>(
          SedovProblem{read.density, read.pressure, read.energy, read.gamma, read.centre, axesOf(level)});
    });
  };
  return kind;
}

}  // namespace tushar::reference
