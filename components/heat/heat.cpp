#include "components/heat/heat.hpp"

#include "core/input/schema.hpp"
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
    temperature[cell] = settings.temperature(middle);
    if (!std::isfinite(temperature[cell]))
      throw InputError({{settings.where, "Heat/temperature",
                         fmt::format("it is {:g} K at ({:g}, {:g}, {:g}), and must be finite everywhere",
                                     temperature[cell], middle[0], middle[1], middle[2])}});
  });
}

template <int D>
void computeStableTimeStep(const Patch& patch, const Settings& settings, Minimum& dt) {
  double sum = 0;
  for (int d = 0; d < D; ++d) sum += 1 / (patch.level().spacing(d) * patch.level().spacing(d));
  dt.add(settings.cfl / (2 * settings.diffusivity() * sum), "conduction");
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
    double curvature = 0;
    for (int d = 0; d < D; ++d)
      curvature += (neighbour<D>(patch, temperature, cell, d, 0) - 2 * temperature[cell] +
                    neighbour<D>(patch, temperature, cell, d, 1)) /
                   (level.spacing(d) * level.spacing(d));
    newTemperature[cell] = temperature[cell] + dt * settings.diffusivity() * curvature;
  });
}

template <int D>
void sumEnergy(const Patch& patch, const Settings& settings, CellView<const double> temperature, Sum& energy) {
  const double capacity = settings.density * settings.specificHeat * patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { energy.add(capacity * temperature[cell]); });
}

namespace {

const input::Schema<Settings>& schema() {
  static const input::Schema<Settings> schema =
      input::Schema<Settings>("Heat", "Heat conduction.")
          .location(&Settings::where)
          .value("thermal_conductivity", &Settings::conductivity, 1, "W/(m K)", "k", input::positive())
          .value("density", &Settings::density, 1, "kg/m^3", "rho", input::positive())
          .value("specific_heat", &Settings::specificHeat, 1, "J/(kg K)", "c", input::positive())
          .value("cfl", &Settings::cfl, 0.9, "1", "part of the greatest stable time step", input::positive(),
                 input::atMost(1))
          .required("temperature", &Settings::temperature, "K", "T at the start", input::WithoutTime());
  return schema;
}

}  // namespace

simulation::ComponentKind kind() {
  simulation::ComponentKind kind;
  kind.name = "heat";
  kind.sentence = "explicit heat conduction; the smallest complete component";
  kind.sections = {"Heat"};
  kind.boundaryLabels = {{"Temperature"}, {"Symmetric"}};
  kind.describe = [](std::ostream& out) { schema().describe(out); };
  kind.read = [](const input::Element& root, input::Diagnostics& diagnostics) {
    const Settings settings = simulation::readSection(root, schema(), diagnostics);
    return [settings](const Level& level) { return simulation::makeByDimension<Heat>(level, settings); };
  };
  return kind;
}

template class Heat<1>;
template class Heat<2>;
template class Heat<3>;

}  // namespace tushar::heat
