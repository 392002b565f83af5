#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_solid_cubic() {
  using namespace mpm::solid;
  defineShapes(Interpolator::cubic, shapesInSpace<mpm::CubicShape>);
  return {};
}

}  // namespace tushar::modules
