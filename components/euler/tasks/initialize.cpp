#include "components/euler/tasks/initialize.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tushar::euler {

namespace {

/// What a state of a gas must be like, for a message.
std::string allowed(const Gas& gas, double density) {
  if (!gas.law) return "a positive density and pressure + p_infinity, and finite values";
  if (!(density > 0)) return "a positive density";
  const auto [least, most] = gas.energyLimits(density);
  const double inset = std::isfinite(most) ? 1e-6 * (most - least) : 0;  // not on the limit, where round-off decides
  const double coldest = gas.temperature(density, (least + inset) * density);
  const double hottest = gas.temperature(density, (most - inset) * density);
  if (!std::isfinite(coldest)) return "a density for which the law of the gas is valid, and finite values";
  const std::string range = std::isfinite(hottest) ? fmt::format("between {:.4g} and {:.4g} K", coldest, hottest)
                                                   : fmt::format("above {:.4g} K", coldest);
  return fmt::format("a temperature {}, where the law of the gas is valid at this density, and finite values", range);
}

void checkState(const Settings& settings, const GasObject& object, const Vec3& point, double density,
                double temperature, double last, const Vec3& velocity) {
  const bool finite = std::isfinite(density) && std::isfinite(last) && velocity.allFinite();
  if (finite && density > 0 && settings.gas.heat(density, last) > 0) return;
  const std::string second = object.temperature
                                 ? fmt::format("temperature {:g} K", temperature)
                                 : fmt::format("pressure {:g} Pa", settings.gas.pressureOf(density, last));
  throw InputError(
      {{placeOf({&object.density.where(), &(object.temperature ? *object.temperature : object.pressure).where(),
                 &object.velocity.where()},
                object.where),
        settings.section + "/geom_object",
        fmt::format("density {:g} kg/m^3, {} and velocity ({:g}, {:g}, {:g}) m/s at ({:g}, {:g}, {:g}); expected {}",
                    density, second, velocity[0], velocity[1], velocity[2], point[0], point[1], point[2],
                    allowed(settings.gas, density))}});
}

}  // namespace

const GasObject* objectAt(const Settings& settings, const Vec3& point) {
  const auto& objects = settings.objects;
  const auto object =
      std::find_if(objects.rbegin(), objects.rend(), [&](const GasObject& one) { return one.shape->owns(point); });
  return object == objects.rend() ? nullptr : &*object;
}

template <int D>
void checkObjects(const Level& level, const Settings& settings) {
  if (settings.objectsMayBeEmpty) return;
  std::vector<InputProblem> problems;
  for (const GasObject& object : settings.objects) {
    const input::Box3 bounds = object.shape->bounds();
    bool found = false;
    forEach<D>(level.cellsNear(bounds.min, bounds.max), [&](const Index<D>& cell) {
      found = found || object.shape->owns(level.expandPoint<D>(level.cellCentre<D>(cell)));
    });
    if (!found)
      problems.push_back(
          {object.where, settings.section + "/geom_object", "its shape contains no cell centre of the grid"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

template <int D>
std::optional<State<D>> stateAt(const Level& level, const Settings& settings, const Vec3& point) {
  const GasObject* object = objectAt(settings, point);
  if (!object) return std::nullopt;
  const double rho = object->density(point);
  double temperature = object->temperature ? (*object->temperature)(point) : 0;
  Vec3 wide = object->velocity(point);
  if (settings.disturb) settings.disturb(point, rho, wide, temperature);
  const double last = object->temperature ? settings.gas.lastAt(rho, temperature) : object->pressure(point);
  checkState(settings, *object, point, rho, temperature, last, wide);
  const Vec<D> v = level.reduce<D>(wide);
  State<D> state;
  state[kDensity] = rho;
  for (int d = 0; d < D; ++d) state[kVelocity(d)] = rho * v[d];
  state[kPressure<D>] = settings.gas.energyOf(rho, last) + 0.5 * rho * v.squaredNorm();
  return state;
}

double shareAt(const Settings& settings, const Vec3& point) {
  const GasObject* object = objectAt(settings, point);
  if (!object) return 0;
  return object->share ? (*object->share)(point) : 1.0;
}

void refuseUncovered(const Settings& settings, const Vec3& point) {
  throw InputError({{settings.where, settings.section,
                     fmt::format("no geom_object contains the centre of the cell at ({:g}, {:g}, {:g}); every cell "
                                 "needs a gas at the start",
                                 point[0], point[1], point[2])}});
}

template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> density, CellView<Vec<D>> momentum,
                CellView<double> totalEnergy) {
  const Level& level = patch.level();
  if (patch.id() == 0) checkObjects<D>(level, settings);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const Vec3 point = level.expandPoint<D>(level.cellCentre<D>(cell));
    const std::optional<State<D>> state = stateAt<D>(level, settings, point);
    if (!state) refuseUncovered(settings, point);
    density[cell] = (*state)[kDensity];
    for (int d = 0; d < D; ++d) momentum[cell][d] = (*state)[kVelocity(d)];
    totalEnergy[cell] = (*state)[kPressure<D>];
  });
}

template void checkObjects<1>(const Level&, const Settings&);
template void checkObjects<2>(const Level&, const Settings&);
template void checkObjects<3>(const Level&, const Settings&);
template std::optional<State<1>> stateAt<1>(const Level&, const Settings&, const Vec3&);
template std::optional<State<2>> stateAt<2>(const Level&, const Settings&, const Vec3&);
template std::optional<State<3>> stateAt<3>(const Level&, const Settings&, const Vec3&);
template void initialize<1>(const Patch&, const Settings&, CellView<double>, CellView<Vec<1>>, CellView<double>);
template void initialize<2>(const Patch&, const Settings&, CellView<double>, CellView<Vec<2>>, CellView<double>);
template void initialize<3>(const Patch&, const Settings&, CellView<double>, CellView<Vec<3>>, CellView<double>);

}  // namespace tushar::euler
