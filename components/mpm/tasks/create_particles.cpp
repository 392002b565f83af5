#include "components/mpm/tasks/create_particles.hpp"

namespace tushar::mpm {

void refuseOverlap(const Gas& gas, const GasObject& object, const Vec3& point) {
  for (const GasObject& other : gas.objects)
    if (&other != &object && other.shape->contains(point))
      throw InputError({{object.where, "geom_object",
                         fmt::format("overlaps the geom_object at {}: both contain the point ({:g}, {:g}, {:g})",
                                     other.where.text(), point[0], point[1], point[2])}});
}

}  // namespace tushar::mpm
