#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_solid_linear() {
  using namespace mpm::solid;
  defineShapes(Interpolator::linear, shapesInSpace<mpm::LinearShape>, shapesAroundAxis<mpm::AxisymmetricLinearShape>);
  return {};
}

}  // namespace tushar::modules
