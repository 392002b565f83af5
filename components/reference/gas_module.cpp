#include "components/reference/gas_module.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "components/reference/gas_solution.hpp"

namespace tushar::reference {

using simulation::MeasuredError;

namespace {

/// Compares the gas of a component with any exact solution.
class GasError : public simulation::Analysis {
 public:
  GasError(std::string module, ReferencePointer exact, const GasSolution& solution)
      : module_(std::move(module)), exact_(std::move(exact)), solution_(&solution) {}

  void schedule(TaskList& tasks) const override { solution_->scheduleMeasureError(tasks, *exact_, clock_); }
  void setTime(double, double sinceStart) override { clock_.time = sinceStart; }
  std::vector<MeasuredError> errors() const override;
  std::string whyUnmeasured() const override {
    if (exact_->holdsAt(clock_.time)) return {};
    return fmt::format("'{}' has no solution at t = {:g} s", module_, clock_.time);
  }
  std::vector<output::Array> exactProfile(const Level& level) const override;

 private:
  std::string module_;
  ReferencePointer exact_;
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
    if (place == MeasuredPlace::particle) add("particle", particleError, {"L1", "L2", "max", "relative"});
    if (place == MeasuredPlace::cell) add("cell", cellError, {"L1", "L2", "relative"});
    if (place == MeasuredPlace::node) errors.push_back({"density", "node", &nodeError, {"max"}});
  }
  return errors;
}

std::vector<output::Array> GasError::exactProfile(const Level& level) const {
  if (level.dimension() != 1 || !exact_->holdsAt(clock_.time)) return {};
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

bool isClose(double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b); }

/// A message if the gases of the scene do not include `gas`; none if they do, or if the scene gives no law.
std::string whyNotAmong(const std::vector<GasLaw>& scene, const GasLaw& gas) {
  const auto isIt = [&](const GasLaw& other) {
    return isClose(gas.gamma, other.gamma) && isClose(gas.stiffness, other.stiffness);
  };
  if (scene.empty() || std::any_of(scene.begin(), scene.end(), isIt)) return {};
  if (scene.size() > 1)
    return fmt::format("gamma and p_infinity: found {:g} and {} Pa, but no gas of the scene has these values",
                       gas.gamma, gas.stiffness);
  if (!isClose(gas.gamma, scene.front().gamma))
    return fmt::format("gamma: found {}, but the gas of the scene has {}", gas.gamma, scene.front().gamma);
  return fmt::format("p_infinity: found {:g} Pa, but the gas of the scene has {:g} Pa", gas.stiffness,
                     scene.front().stiffness);
}

}  // namespace

simulation::MakeAnalysis measureAgainst(std::function<ReferencePointer(const Level&)> build, const GasTags& tags,
                                        const std::vector<GasLaw>& gases, const input::Element& module) {
  const auto problem = [where = module.where(), path = module.path()](const std::string& sentence) {
    return InputError({InputProblem{where, path, sentence}});
  };
  return [build = std::move(build), problem, gases, name = tags.name, within = tags.within](
             const Component& component, const Level& level) -> std::unique_ptr<simulation::Analysis> {
    const auto* solution = dynamic_cast<const GasSolution*>(&component);
    if (!solution) throw problem("measures errors of a gas, but this component has no gas; remove the module");
    try {
      ReferencePointer exact = build(level);
      for (const GasLaw& gas : gases)
        if (const std::string missing = whyNotAmong(solution->gases(), gas); !missing.empty()) throw problem(missing);
      if (within) exact = std::make_shared<Within>(exact, *within);
      return std::make_unique<GasError>(name, std::move(exact), *solution);
    } catch (const std::invalid_argument& error) {
      throw problem(error.what());
    }
  };
}

}  // namespace tushar::reference
