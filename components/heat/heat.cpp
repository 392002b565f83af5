#include "components/heat/heat.hpp"

#include "components/heat/conduct_implicitly.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/by_dimension.hpp"
#include "core/solvers/input.hpp"

namespace tushar::heat {

template <int D>
void Heat<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.perPatch("heat::initialize", initialize<D>, with(settings_), computes(c::temperature));
}

template <int D>
void Heat<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  if (settings_.theta > 0)
    tasks.perPatch(
        "heat::allowAnyTimeStep", [](const Patch&, Minimum&) {}, computes(delT));
  else
    tasks.perPatch("heat::computeStableTimeStep", computeStableTimeStep<D>, with(settings_), computes(delT));
}

template <int D>
void Heat<D>::scheduleTimeAdvance(TaskList& tasks) const {
  if (settings_.theta > 0)
    tasks.perRank("heat::conductImplicitly", conductImplicitly<D>, togetherOnRanks(), with(settings_),
                  requiresOld(delT), requiresOld(c::temperature, 1), computes(c::temperature), computes(iterations),
                  computes(solvers::assemblyTime), computes(solvers::preconditionerTime), computes(solvers::solveTime));
  else
    tasks.perPatch("heat::conduct", conduct<D>, with(settings_), requiresOld(c::temperature, 1), requiresOld(delT),
                   computes(c::temperature));
}

template <int D>
void Heat<D>::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perPatch("heat::sumEnergy", sumEnergy<D>, with(settings_), requiresOld(c::temperature), computes(totalEnergy));
}

template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> temperature) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const Vec3 middle = level.expandPoint<D>(level.cellCentre<D>(cell));
    const auto refuse = [&](const char* tag, double found, const char* unit, const char* wanted) {
      throw InputError({{settings.where, tag,
                         fmt::format("it is {:g} {} at ({:g}, {:g}, {:g}), and must be {} everywhere", found, unit,
                                     middle[0], middle[1], middle[2], wanted)}});
    };
    temperature[cell] = settings.temperature(middle);
    if (!std::isfinite(temperature[cell])) refuse("Heat/temperature", temperature[cell], "K", "finite");
    const double k = settings.conductivity(middle);
    if (!(k > 0 && std::isfinite(k))) refuse("Heat/thermal_conductivity", k, "W/(m K)", "finite and greater than 0");
  });
}

namespace {

/// k in the middle of a cell of the grid or of its periodic images [W/(m K)].
template <int D>
double conductivityIn(const Level& level, const Settings& settings, const Index<D>& cell) {
  return settings.conductivity(level.expandPoint<D>(level.cellCentre<D>(level.wrapped(cell))));
}

/// k at a face of a cell [W/(m K)]; at the rim of the grid that of the cell.
template <int D>
double conductivityAt(const Patch& patch, const Settings& settings, const Index<D>& cell, int d, int side) {
  const double own = conductivityIn<D>(patch.level(), settings, cell);
  const Index<D> next = side == 0 ? cell - Index<D>::unit(d) : cell + Index<D>::unit(d);
  if (settings.conductivity.isConstant() || !patch.cellsWithin(1).contains(next)) return own;
  const double other = conductivityIn<D>(patch.level(), settings, next);
  return 2 * own * other / (own + other);
}

}  // namespace

template <int D>
void computeStableTimeStep(const Patch& patch, const Settings& settings, Minimum& dt) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double sum = 0;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1})
        sum += conductivityAt<D>(patch, settings, cell, d, side) / (level.spacing(d) * level.spacing(d));
    dt.add(settings.cfl * settings.capacity() / sum, "conduction");
  });
}

namespace {

/// T in the cell next to `cell` along axis `d`; beyond the grid, what makes the boundary condition hold at the face.
template <int D>
double neighbour(const Patch& patch, CellView<const double> temperature, const Index<D>& cell, int d, int side) {
  const Index<D> next = side == 0 ? cell - Index<D>::unit(d) : cell + Index<D>::unit(d);
  if (patch.cellsWithin(1).contains(next)) return temperature[next];
  const Level& level = patch.level();
  const auto* condition = level.boundary(d, side, "Temperature");
  if (!condition) return temperature[cell];
  if (condition->kind == "Dirichlet") return 2 * condition->value[0] - temperature[cell];
  return temperature[cell] + level.spacing(d) * condition->value[0];
}

}  // namespace

template <int D>
void conduct(const Patch& patch, const Settings& settings, CellView<const double> temperature, double dt,
             CellView<double> newTemperature) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double heating = 0;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1})
        heating += conductivityAt<D>(patch, settings, cell, d, side) *
                   (neighbour<D>(patch, temperature, cell, d, side) - temperature[cell]) /
                   (level.spacing(d) * level.spacing(d));
    newTemperature[cell] = temperature[cell] + dt / settings.capacity() * heating;
  });
}

template <int D>
void sumEnergy(const Patch& patch, const Settings& settings, CellView<const double> temperature, Sum& energy) {
  const double capacity = settings.capacity() * patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { energy.add(capacity * temperature[cell]); });
}

namespace {

const input::Schema<Settings>& schema() {
  static const input::Schema<Settings> schema =
      input::Schema<Settings>("Heat", "Heat conduction.")
          .location(&Settings::where)
          .value("thermal_conductivity", &Settings::conductivity, input::Expression(1.0), "W/(m K)", "k",
                 input::WithoutTime(), input::positive())
          .value("density", &Settings::density, 1, "kg/m^3", "rho", input::positive())
          .value("specific_heat", &Settings::specificHeat, 1, "J/(kg K)", "c", input::positive())
          .value("cfl", &Settings::cfl, 0.9, "1", "part of the greatest stable time step", input::positive(),
                 input::atMost(1))
          .choice("time_integrator", &Settings::theta,
                  {{"explicit", 0}, {"backward_euler", 1}, {"crank_nicolson", 0.5}}, 0,
                  "how time advances; the steps of the implicit ones are those of <Time>")
          .section("Solver", &Settings::solver, solvers::linearSchema(), "the linear solves of an implicit one")
          .required("temperature", &Settings::temperature, "K", "T at the start", input::WithoutTime());
  return schema;
}

}  // namespace

simulation::ComponentKind kind() {
  return simulation::kindWithSection<Heat>("heat",
                                           "heat conduction, explicit or implicit; the smallest complete component",
                                           schema(), {{"Temperature"}, {"Symmetric"}});
}

template class Heat<1>;
template class Heat<2>;
template class Heat<3>;

}  // namespace tushar::heat
