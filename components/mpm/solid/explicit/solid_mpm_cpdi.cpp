#include "components/mpm/shapes/cpdi_shape.hpp"
#include "components/mpm/solid/explicit/define_shapes.hpp"
#include "components/mpm/solid/transfer/cpdi_transfer.hpp"

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_cpdi() {
  defineShapes(Interpolator::cpdi, shapesInSpace<CpdiShape>(), shapesAroundAxis<AxisymmetricCpdiShape>());
  return {};
}

}  // namespace tushar::modules
