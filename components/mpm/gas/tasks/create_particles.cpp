#include "components/mpm/gas/tasks/create_particles.hpp"

#include "components/mpm/particles/mixed.hpp"

namespace tushar::mpm::gas {

double drawn(int seed, std::uint64_t cellNumber, int place, int axis) {
  const auto counter = static_cast<std::uint64_t>(3 * place + axis);
  const std::uint64_t bits = mixed(mixed(mixed(static_cast<std::uint64_t>(seed)) + cellNumber) + counter);
  return (static_cast<double>(bits >> 32) + 0.5) * 0x1p-32;  // half an interval away from either end
}

void refuseOverlap(const Gas& gas, const GasObject& object, const Vec3& point) {
  for (const GasObject& other : gas.objects)
    if (&other != &object && other.shape->owns(point))
      throw InputError({{object.where, "geom_object",
                         fmt::format("overlaps the geom_object at {}: both contain the point ({:g}, {:g}, {:g})",
                                     other.where.text(), point[0], point[1], point[2])}});
}

InputProblem emptyBody(const Level& level, const GasObject& object) {
  const std::string leftOut = level.axesLeftOut(), middle = ", in the middle of the grid along " + leftOut;
  const Index3& each = object.particlesPerCell;
  return {
      object.where, "geom_object",
      fmt::format(
          "it has no particle: none of the points where particles start ([{},{},{}] per cell{}) is inside its shape",
          each[0], each[1], each[2], leftOut.empty() ? "" : middle)};
}

void refuseImpossible(const GasObject& object, const Vec3& point, double density, double pressure,
                      const Vec3& velocity) {
  const char* what = nullptr;
  const Location* where = nullptr;
  double value = 0;
  if (!(density > 0) || !std::isfinite(density)) {
    what = "density";
    where = &object.density.where();
    value = density;
  } else if (!(pressure >= 0) || !std::isfinite(pressure)) {
    what = "pressure";
    where = &object.pressure.where();
    value = pressure;
  } else if (!velocity.allFinite()) {
    what = "velocity";
    where = &object.velocity.where();
    value = velocity.sum();
  }
  if (!what) return;
  throw InputError({{placeOf({where}, object.where), "geom_object",
                     fmt::format("its {} is {:g} at the point ({:g}, {:g}, {:g}); expected a density greater than 0, a "
                                 "pressure of at least 0, and only finite values",
                                 what, value, point[0], point[1], point[2])}});
}

}  // namespace tushar::mpm::gas
