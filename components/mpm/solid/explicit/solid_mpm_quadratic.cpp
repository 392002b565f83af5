#include "components/mpm/solid/explicit/make.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<QuadraticShape<1>>;
template class SolidMpm<QuadraticShape<2>>;
template class SolidMpm<QuadraticShape<3>>;

}  // namespace tushar::mpm::solid

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_quadratic() {
  defineSolids(Interpolator::quadratic, makeSolids<QuadraticShape>);
  return {};
}

}  // namespace tushar::modules
