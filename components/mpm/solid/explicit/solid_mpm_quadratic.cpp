#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_quadratic() {
  defineShapes(Interpolator::quadratic, shapesInSpace<QuadraticShape>());
  return {};
}

}  // namespace tushar::modules
