#include "components/heat/heat.hpp"

#include "core/input/refuse.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::heat {

template <int D>
void Heat<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.perPatch("heat::initialize", initialize<D>, with(settings_), computes(c::temperature));
}

template <int D>
void Heat<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perPatch("heat::computeStableTimeStep", computeStableTimeStep<D>, with(settings_), computes(delT));
}

template <int D>
void Heat<D>::scheduleTimeAdvance(TaskList& tasks) const {
  tasks.perPatch("heat::conduct", conduct<D>, with(settings_), requiresOld(c::temperature, 1), requiresOld(delT),
                 computes(c::temperature), keepsFlux(c::temperature));
}

template <int D>
void Heat<D>::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perPatch("heat::sumEnergy", sumEnergy<D>, with(settings_), requiresOld(c::temperature), computes(totalEnergy));
}

template <int D>
void Heat<D>::scheduleErrorEstimate(TaskList& tasks) const {
  if (settings_.refinementTolerance > 0)
    tasks.perPatch("heat::estimateError", estimateError<D>, with(settings_.refinementTolerance),
                   requiresOld(c::temperature, 1), marks());
}

simulation::ComponentKind kind() {
  static const input::Schema<Settings> schema = [] {
    input::Schema<Settings> section("Heat", "Heat conduction, explicit in time.");
    section.allOurs()
        .value("thermal_conductivity", &Settings::conductivity, input::Expression(1.0), "W/(m K)", "k",
               input::WithoutTime(), input::positive())
        .value("density", &Settings::density, 1, "kg/m^3", "rho", input::positive())
        .value("specific_heat", &Settings::specificHeat, 1, "J/(kg K)", "c", input::positive())
        .value("cfl", &Settings::cfl, 0.9, "1", "fraction of the largest stable time step", input::positive(),
               input::atMost(1))
        .required("temperature", &Settings::temperature, "K", "T at the start", input::WithoutTime())
        .value("refinement_tolerance", &Settings::refinementTolerance, 0, "K",
               "an adaptive grid refines cells where the error of linear interpolation between them exceeds this "
               "value; 0: only a <Variable> of <AMR> refines them",
               input::nonNegative());
    input::refuseOtherValues(section, "time_integrator", {"explicit"},
                             "for implicit steps, use <SimulationComponent type=\"implicit_heat\"/>");
    input::refuseTag(section, "Solver",
                     "explicit steps solve no linear system; <SimulationComponent type=\"implicit_heat\"/> does");
    return section;
  }();
  simulation::ComponentKind kind =
      simulation::kindWithSection<Heat>("heat", "heat conduction, explicit; the smallest complete component", schema,
                                        {boundary::temperature, grid::symmetric});
  kind.takesLevels = true;
  kind.takesPartsOfSides = true;
  return kind;
}

template class Heat<1>;
template class Heat<2>;
template class Heat<3>;

}  // namespace tushar::heat
