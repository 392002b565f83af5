#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_cubic() {
  defineShapes(Interpolator::cubic, shapesInSpace<CubicShape>());
  return {};
}

}  // namespace tushar::modules
