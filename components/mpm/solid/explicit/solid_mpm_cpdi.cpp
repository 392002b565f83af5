#include "components/mpm/shapes/cpdi_shape.hpp"
#include "components/mpm/solid/explicit/define_shapes.hpp"
#include "components/mpm/solid/transfer/cpdi_transfer.hpp"

namespace tushar::mpm::solid {
namespace {

constexpr TasksOfShapes inSpace = shapesInSpace<CpdiShape>();
constexpr TasksOfShapes aroundAxis = shapesAroundAxis<AxisymmetricCpdiShape>();

}  // namespace
}  // namespace tushar::mpm::solid

namespace tushar::modules {

using namespace mpm::solid;

simulation::Catalogue mpm_solid_cpdi() {
  defineShapes(Interpolator::cpdi, inSpace, aroundAxis);
  return {};
}

}  // namespace tushar::modules
