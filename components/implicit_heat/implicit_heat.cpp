#include "components/implicit_heat/implicit_heat.hpp"

#include "core/input/schema.hpp"
#include "core/numerics/cell_system.hpp"
#include "core/numerics/composite_diffusion.hpp"
#include "core/simulation/by_dimension.hpp"
#include "core/solvers/input.hpp"

namespace tushar::implicit_heat {

template <int D>
void ImplicitHeat<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.perPatch("implicit_heat::initialize", heat::initialize<D>, with(settings_), computes(c::temperature));
}

template <int D>
void ImplicitHeat<D>::scheduleTimeAdvance(TaskList& tasks) const {
  tasks.perRank("implicit_heat::conduct", conduct<D>, withWorkers(), with(settings_), requiresOld(delT),
                requiresOld(c::temperature), computes(c::temperature), computes(iterations),
                computes(solvers::assemblyTime), computes(solvers::preconditionerTime), computes(solvers::solveTime));
}

template <int D>
void ImplicitHeat<D>::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perPatch("implicit_heat::sumEnergy", heat::sumEnergy<D>, with(settings_), requiresOld(c::temperature),
                 computes(totalEnergy));
}

namespace {

/// Extrapolates T to the time dt from T at the time theta dt, which `newTemperature` contains.
template <int D>
void extrapolate(const RankPatches& patches, double theta, const std::vector<CellView<const double>>& temperature,
                 const std::vector<CellView<double>>& newTemperature) {
  for (std::size_t p = 0; p < patches.size(); ++p)
    forEach<D>(patches[p]->cells(), [&](const Index<D>& cell) {
      newTemperature[p][cell] = temperature[p][cell] + (newTemperature[p][cell] - temperature[p][cell]) / theta;
    });
}

}  // namespace

template <int D>
void conduct(const RankPatches& patches, const Workers& workers, const Settings& settings, double dt,
             const std::vector<CellView<const double>>& temperature,
             const std::vector<CellView<double>>& newTemperature, Maximum& iterationsTaken, Maximum& assembly,
             Maximum& setup, Maximum& solution) {
  const double theta = settings.theta;
  const numerics::CompositeDiffusion<D> diffusion(patches.front()->level().grid(), settings.conductivity,
                                                  boundary::temperature);
  const auto equationOf = [&](std::size_t p, const Index<D>& cell) {
    const Level& level = patches[p]->level();
    const double capacity = settings.capacity() * level.cellVolume() / (theta * dt);
    numerics::Balance<D> balance = diffusion.balance(level.number(), cell);
    balance.scale(-1);
    balance.weights[0] += capacity;
    const double right = capacity * temperature[p][cell] + balance.constant;
    return numerics::CellEquation<D>{std::move(balance), right};
  };
  numerics::CellSystem<D> system(patches, workers);
  const solvers::Outcome outcome = system.solve(settings.solver, temperature, equationOf);
  system.requireConvergence(outcome, "the conduction of heat", "Heat", "c.temperature", ", or a smaller <delt_max>");
  system.take(newTemperature);
  if (theta < 1) extrapolate<D>(patches, theta, temperature, newTemperature);
  iterationsTaken.add(outcome.krylovIterations);
  solvers::addTimes(outcome, assembly, setup, solution);
}

namespace {

const input::Schema<Settings>& schema() {
  static const input::Schema<Settings> schema =
      input::Schema<Settings>("Heat", "Heat conduction, implicit in time.")
          .allOurs()
          .value("thermal_conductivity", input::memberOf<Settings>(&Settings::conductivity), input::Expression(1.0),
                 "W/(m K)", "k", input::WithoutTime(), input::positive())
          .value("density", input::memberOf<Settings>(&Settings::density), 1, "kg/m^3", "rho", input::positive())
          .value("specific_heat", input::memberOf<Settings>(&Settings::specificHeat), 1, "J/(kg K)", "c",
                 input::positive())
          .choice("time_integrator", &Settings::theta, {{"backward_euler", 1}, {"crank_nicolson", 0.5}}, 1,
                  "the time integrator; <Time> sets the steps")
          .elsewhere("explicit", "for explicit steps, use <SimulationComponent type=\"heat\"/>")
          .section("Solver", &Settings::solver, solvers::linearSchema(), "the linear solve of each step")
          .ignored("cfl", "implicit steps have no limit; only <SimulationComponent type=\"heat\"/> uses it")
          .required("temperature", input::memberOf<Settings>(&Settings::temperature), "K", "T at the start",
                    input::WithoutTime());
  return schema;
}

}  // namespace

simulation::ComponentKind kind() {
  simulation::ComponentKind kind =
      simulation::kindWithSection<ImplicitHeat>("implicit_heat", "heat conduction, implicit: stable with any time step",
                                                schema(), {boundary::temperature, grid::symmetric});
  kind.takesLevels = true;
  kind.amrSections = {"Heat"};
  kind.takesPartsOfSides = true;
  return kind;
}

template class ImplicitHeat<1>;
template class ImplicitHeat<2>;
template class ImplicitHeat<3>;

}  // namespace tushar::implicit_heat
