#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::mpm::solid {
namespace {

constexpr TasksOfShapes inSpace = shapesInSpace<QuadraticShape>();

}  // namespace
}  // namespace tushar::mpm::solid

namespace tushar::modules {

using namespace mpm::solid;

simulation::Catalogue mpm_solid_quadratic() {
  defineShapes(Interpolator::quadratic, inSpace);
  return {};
}

}  // namespace tushar::modules
