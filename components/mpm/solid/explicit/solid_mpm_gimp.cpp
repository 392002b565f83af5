#include "components/mpm/solid/explicit/make.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<GimpShape<1>>;
template class SolidMpm<GimpShape<2>>;
template class SolidMpm<GimpShape<3>>;
template class SolidMpm<AxisymmetricGimpShape<1>>;
template class SolidMpm<AxisymmetricGimpShape<2>>;

}  // namespace tushar::mpm::solid

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_gimp() {
  defineSolids(Interpolator::gimp, makeSolids<GimpShape>, makeAxisymmetricSolids<AxisymmetricGimpShape>);
  return {};
}

}  // namespace tushar::modules
