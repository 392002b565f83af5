#include "components/mpm/solid/explicit/make.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<CubicShape<1>>;
template class SolidMpm<CubicShape<2>>;
template class SolidMpm<CubicShape<3>>;

}  // namespace tushar::mpm::solid

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_cubic() {
  defineSolids(Interpolator::cubic, makeSolids<CubicShape>);
  return {};
}

}  // namespace tushar::modules
