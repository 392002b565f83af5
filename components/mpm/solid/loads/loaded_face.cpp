#include "components/mpm/solid/loads/loaded_face.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace tushar::mpm::solid {

std::optional<LoadedFace> ParticleBox::face(const Vec3& normal) const {
  std::optional<LoadedFace> found;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 half = 0.5 * edges.col(axis);
    const double cosine = normal.dot(half) / half.norm();
    if (std::abs(cosine) <= 0.9) continue;
    const Vec3 centre = cosine > 0 ? Vec3(middle + half) : Vec3(middle - half);
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const Vec3 a = 0.5 * edges.col(i), b = 0.5 * edges.col(j);
    const double area = edges.col(i).cross(edges.col(j)).norm();
    found = {{centre - a + b, centre + a - b, centre - a - b, centre + a + b},
             area / startEdges.col(i).cross(startEdges.col(j)).norm()};
  }
  return found;
}

std::optional<CornerLoad> cornerLoad(const Loads& loads, int packed, const ParticleBox& particle, double time) {
  std::optional<CornerLoad> sum;
  Vec3 torque = Vec3::Zero();
  const auto add = [&](const SurfaceLoad& load) {
    if (load.kind == LoadKind::torque) torque += load.force(particle.middle, time);
    if (load.kind != LoadKind::pressure) return;
    const Vec3 normal = normalAt(load.surface, particle.middle);
    const auto face = particle.face(load.outwardNormal ? normal : Vec3(-normal));
    if (!face) return;
    const Vec3 before = sum ? sum->force : Vec3(Vec3::Zero());
    sum = {before + face->stretch * load.force(particle.middle, time), face->corners};
  };
  forEachLoad(loads, packed, add, [](const BodyLoad&) {});
  if (sum) sum->force += 4 * torque;
  return sum;
}

}  // namespace tushar::mpm::solid
