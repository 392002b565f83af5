#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::mpm::solid {
namespace {

constexpr TasksOfShapes inSpace = shapesInSpace<LinearShape>();
constexpr TasksOfShapes aroundAxis = shapesAroundAxis<AxisymmetricLinearShape>();

}  // namespace
}  // namespace tushar::mpm::solid

namespace tushar::modules {

using namespace mpm::solid;

simulation::Catalogue mpm_solid_linear() {
  defineShapes(Interpolator::linear, inSpace, aroundAxis);
  return {};
}

}  // namespace tushar::modules
