#include "components/mpm/tasks/create_particles.hpp"

namespace tushar::mpm {

void refuseOverlap(const Gas& gas, const GasObject& object, const Vec3& point) {
  for (const GasObject& other : gas.objects)
    if (&other != &object && other.shape->contains(point))
      throw InputError({{object.where, "geom_object",
                         fmt::format("overlaps the geom_object at {}: both contain the point ({:g}, {:g}, {:g})",
                                     other.where.text(), point[0], point[1], point[2])}});
}

void refuseImpossible(const GasObject& object, const Vec3& point, double density, double pressure,
                      const Vec3& velocity) {
  const char* what = nullptr;
  double value = 0;
  if (!(density > 0) || !std::isfinite(density)) {
    what = "density";
    value = density;
  } else if (!(pressure >= 0) || !std::isfinite(pressure)) {
    what = "pressure";
    value = pressure;
  } else if (!velocity.allFinite()) {
    what = "velocity";
    value = velocity.sum();
  }
  if (!what) return;
  throw InputError({{object.where, "geom_object",
                     fmt::format("its {} is {:g} at the point ({:g}, {:g}, {:g}); density must be greater than 0, pressure at "
                                 "least 0, and all must be finite",
                                 what, value, point[0], point[1], point[2])}});
}

}  // namespace tushar::mpm
