#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_linear() {
  defineShapes(Interpolator::linear, shapesInSpace<LinearShape>(), shapesAroundAxis<AxisymmetricLinearShape>());
  return {};
}

}  // namespace tushar::modules
