#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_gimp() {
  defineShapes(Interpolator::gimp, shapesInSpace<GimpShape>(), shapesAroundAxis<AxisymmetricGimpShape>());
  return {};
}

}  // namespace tushar::modules
