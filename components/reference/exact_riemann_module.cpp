#include "components/reference/exact_riemann.hpp"
#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"

namespace tushar::reference {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::AnalysisKind;

namespace {

struct State {
  double density = 0, pressure = 0, velocity = 0;
};
const Schema<State>& stateSchema() {
  static const Schema<State> schema = Schema<State>("left", "A uniform gas.")
                                          .required("density", &State::density, "kg/m^3", "rho", input::nonNegative())
                                          .required("pressure", &State::pressure, "Pa", "p", input::nonNegative())
                                          .value("velocity", &State::velocity, 0, "m/s", "u along the axis");
  return schema;
}

struct RiemannSection : GasTags {
  State left, right;
  double diaphragm = 0.5;
  int axis = 0;
};
const Schema<RiemannSection>& riemannSchema() {
  static const Schema<RiemannSection> schema = [] {
    Schema<RiemannSection> declared("Module", "Errors against the exact solution of a shock tube (Toro, ch. 4).");
    declareGasTags(declared, "exactRiemann");
    declared.requiredSection("left", &RiemannSection::left, stateSchema(), "the gas below the diaphragm")
        .ours()
        .requiredSection("right", &RiemannSection::right, stateSchema(), "the gas above it")
        .ours()
        .value("diaphragm", &RiemannSection::diaphragm, 0.5, "m", "where the two meet at t = 0")
        .ours()
        .choice("axis", &RiemannSection::axis, {{"x", 0}, {"y", 1}, {"z", 2}}, 0, "the normal of the diaphragm")
        .ours();
    return declared;
  }();
  return schema;
}

}  // namespace

AnalysisKind exactRiemannKind() {
  AnalysisKind kind{"exactRiemann", "errors against the exact solution of a shock tube", {}, {}};
  kind.describe = [](std::ostream& out) { riemannSchema().describe(out); };
  kind.read = [](const Element& module, Diagnostics& diagnostics) {
    return readModule(riemannSchema(), module, diagnostics, [](const RiemannSection& read) {
      RiemannProblem problem;
      problem.left = {read.left.density, read.left.velocity, read.left.pressure};
      problem.right = {read.right.density, read.right.velocity, read.right.pressure};
      problem.gamma = read.gamma;
      problem.diaphragm = read.diaphragm;
      problem.axis = read.axis;
      return std::make_shared<ExactRiemann>(problem);
    });
  };
  return kind;
}

}  // namespace tushar::reference
