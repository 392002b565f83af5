#include "components/mpm/solid/explicit/define_shapes.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_solid_quadratic() {
  using namespace mpm::solid;
  defineShapes(Interpolator::quadratic, shapesInSpace<mpm::QuadraticShape>);
  return {};
}

}  // namespace tushar::modules
