#include "components/mpm/shapes/cpdi_shape.hpp"
#include "components/mpm/solid/explicit/define_shapes.hpp"
#include "components/mpm/solid/transfer/cpdi_transfer.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_solid_cpdi() {
  using namespace mpm::solid;
  defineShapes(Interpolator::cpdi, shapesInSpace<mpm::CpdiShape>, shapesAroundAxis<mpm::AxisymmetricCpdiShape>);
  return {};
}

}  // namespace tushar::modules
