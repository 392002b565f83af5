#include "components/mpm/solid/explicit/make.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<LinearShape<1>>;
template class SolidMpm<LinearShape<2>>;
template class SolidMpm<LinearShape<3>>;
template class SolidMpm<AxisymmetricLinearShape<1>>;
template class SolidMpm<AxisymmetricLinearShape<2>>;

}  // namespace tushar::mpm::solid

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_linear() {
  defineSolids(Interpolator::linear, makeSolids<LinearShape>, makeAxisymmetricSolids<AxisymmetricLinearShape>);
  return {};
}

}  // namespace tushar::modules
