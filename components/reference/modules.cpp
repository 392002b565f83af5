#include "components/reference/modules.hpp"

#include <fmt/format.h>

#include "components/reference/exact_riemann.hpp"
#include "components/reference/gas_solution.hpp"
#include "components/reference/simple_wave.hpp"
#include "core/input/schema.hpp"

namespace tushar::reference {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::AnalysisKind;
using simulation::MeasuredError;

namespace {

/// Measures a component's gas against an exact solution, whatever that is.
class GasError : public simulation::Analysis {
 public:
  GasError(std::shared_ptr<const GasReference> exact, const GasSolution& solution)
      : exact_(std::move(exact)), solution_(&solution) {}

  void schedule(TaskList& tasks) const override { solution_->scheduleMeasureError(tasks, *exact_, clock_); }
  void setTime(double time) override { clock_.time = time; }
  std::vector<MeasuredError> errors() const override;
  std::vector<output::Array> exactProfile(const Level& level) const override;

 private:
  std::shared_ptr<const GasReference> exact_;
  const GasSolution* solution_;
  Clock clock_;
};

std::vector<MeasuredError> GasError::errors() const {
  std::vector<MeasuredError> errors;
  const auto add = [&](const char* place, const GasErrorLabels& labels, const std::vector<std::string>& norms) {
    errors.push_back({"density", place, &labels.density, norms});
    errors.push_back({"velocity", place, &labels.velocity, norms});
    errors.push_back({"pressure", place, &labels.pressure, norms});
    errors.push_back({"energy", place, &labels.energy, norms});
  };
  for (const MeasuredPlace place : solution_->measuredPlaces()) {
    if (place == MeasuredPlace::particle) add("particle", particleError, {"L1", "L2", "max"});
    if (place == MeasuredPlace::cell) add("cell", cellError, {"L1", "L2"});
    if (place == MeasuredPlace::node) errors.push_back({"density", "node", &nodeError, {"max"}});
  }
  return errors;
}

std::vector<output::Array> GasError::exactProfile(const Level& level) const {
  if (level.dimension() != 1) return {};
  constexpr int points = 2000;
  std::vector<std::vector<double>> columns(5);
  for (int k = 0; k <= points; ++k) {
    const double at = level.nodePosition(0, 0) +
                      (level.nodePosition(0, level.cells().upper[0]) - level.nodePosition(0, 0)) * k / points;
    Vec<1> x;
    x[0] = at;
    const GasState state = exact_->at(level.expandPoint<1>(x), clock_.time);
    columns[0].push_back(at);
    columns[1].push_back(state.density);
    columns[2].push_back(state.velocity[level.axis(0)]);
    columns[3].push_back(state.pressure);
    columns[4].push_back(state.energy);
  }
  return {{"x", "m", "position", 1, columns[0]},
          {"density", "kg/m^3", "exact density", 1, columns[1]},
          {"velocity", "m/s", "exact velocity", 1, columns[2]},
          {"pressure", "Pa", "exact pressure", 1, columns[3]},
          {"energy", "J/kg", "exact internal energy", 1, columns[4]}};
}

/// Makes the module, if the component solves for a gas.
simulation::MakeAnalysis makeFor(std::shared_ptr<const GasReference> exact, const Element& module) {
  const InputProblem misfit{module.where(), module.path(),
                            "measures a gas, but this component does not solve for one; take the module out"};
  return [exact = std::move(exact), misfit](const Component& component,
                                            const Level&) -> std::unique_ptr<simulation::Analysis> {
    const auto* solution = dynamic_cast<const GasSolution*>(&component);
    if (!solution) throw InputError({misfit});
    return std::make_unique<GasError>(exact, *solution);
  };
}

/// Builds an exact solution; what it refuses becomes a problem of the module.
template <class Build>
simulation::MakeAnalysis buildFor(const Element& module, Diagnostics& diagnostics, std::size_t before,
                                  const Build& build) {
  if (diagnostics.size() > before) return {};
  try {
    return makeFor(build(), module);
  } catch (const std::invalid_argument& error) {
    diagnostics.error(module, error.what());
    return {};
  }
}

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

struct RiemannSection {
  std::string name;
  State left, right;
  double gamma = 1.4, diaphragm = 0.5;
  int axis = 0;
};
const Schema<RiemannSection>& riemannSchema() {
  static const Schema<RiemannSection> schema =
      Schema<RiemannSection>("Module", "Errors against the exact solution of a shock tube (Toro, ch. 4).")
          .requiredAttribute("name", &RiemannSection::name, "1", "exactRiemann")
          .requiredSection("left", &RiemannSection::left, stateSchema(), "the gas below the diaphragm")
          .ours()
          .requiredSection("right", &RiemannSection::right, stateSchema(), "the gas above it")
          .ours()
          .value("gamma", &RiemannSection::gamma, 1.4, "1", "ratio of specific heats", input::greaterThan(1))
          .ours()
          .value("diaphragm", &RiemannSection::diaphragm, 0.5, "m", "where the two meet at t = 0")
          .ours()
          .choice("axis", &RiemannSection::axis, {{"x", 0}, {"y", 1}, {"z", 2}}, 0, "the normal of the diaphragm")
          .ours();
  return schema;
}

struct WaveSection {
  std::string name;
  input::Expression velocity{0.0};
  double density = 1, soundSpeed = 1, gamma = 1.4;
  double lower = 0, upper = 1;
};
const Schema<WaveSection>& waveSchema() {
  static const Schema<WaveSection> schema =
      Schema<WaveSection>("Module", "Errors against a simple wave that runs to the right into gas at rest.")
          .requiredAttribute("name", &WaveSection::name, "1", "simpleWave")
          .required("velocity", &WaveSection::velocity, "m/s", "velocity at t = 0, a formula in x")
          .ours()
          .value("density", &WaveSection::density, 1, "kg/m^3", "density at rest", input::positive())
          .ours()
          .value("sound_speed", &WaveSection::soundSpeed, 1, "m/s", "speed of sound at rest", input::positive())
          .ours()
          .value("gamma", &WaveSection::gamma, 1.4, "1", "ratio of specific heats", input::greaterThan(1))
          .ours()
          .value("lower", &WaveSection::lower, 0, "m", "where the profile begins")
          .ours()
          .value("upper", &WaveSection::upper, 1, "m", "where the profile ends")
          .ours();
  return schema;
}

}  // namespace

AnalysisKind exactRiemannKind() {
  AnalysisKind kind{"exactRiemann", "errors against the exact solution of a shock tube", {}, {}};
  kind.describe = [](std::ostream& out) { riemannSchema().describe(out); };
  kind.read = [](const Element& module, Diagnostics& diagnostics) {
    const std::size_t before = diagnostics.size();
    const RiemannSection read = riemannSchema().read(module, diagnostics);
    return buildFor(module, diagnostics, before, [&] {
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

AnalysisKind simpleWaveKind() {
  AnalysisKind kind{"simpleWave", "errors against a right-running simple wave", {}, {}};
  kind.describe = [](std::ostream& out) { waveSchema().describe(out); };
  kind.read = [](const Element& module, Diagnostics& diagnostics) {
    const std::size_t before = diagnostics.size();
    const WaveSection read = waveSchema().read(module, diagnostics);
    return buildFor(module, diagnostics, before, [&] {
      SimpleWaveProblem problem;
      problem.velocity = [velocity = read.velocity](double x) { return velocity(Vec3(x, 0, 0)); };
      problem.density = read.density;
      problem.soundSpeed = read.soundSpeed;
      problem.gamma = read.gamma;
      problem.lower = read.lower;
      problem.upper = read.upper;
      return std::make_shared<SimpleWave>(problem);
    });
  };
  return kind;
}

}  // namespace tushar::reference
