#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_solid_gimp() {
  using namespace mpm::solid;
  defineShapes(Interpolator::gimp, shapesInSpace<mpm::GimpShape>, shapesAroundAxis<mpm::AxisymmetricGimpShape>);
  return {};
}

}  // namespace tushar::modules
