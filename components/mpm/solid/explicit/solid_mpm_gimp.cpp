#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::mpm::solid {
namespace {

constexpr TasksOfShapes inSpace = shapesInSpace<GimpShape>();
constexpr TasksOfShapes aroundAxis = shapesAroundAxis<AxisymmetricGimpShape>();

}  // namespace
}  // namespace tushar::mpm::solid

namespace tushar::modules {

using namespace mpm::solid;

simulation::Catalogue mpm_solid_gimp() {
  defineShapes(Interpolator::gimp, inSpace, aroundAxis);
  return {};
}

}  // namespace tushar::modules
