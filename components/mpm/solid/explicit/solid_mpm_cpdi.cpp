#include "components/mpm/shapes/cpdi_shape.hpp"
#include "components/mpm/solid/explicit/make.hpp"
#include "components/mpm/solid/transfer/cpdi_transfer.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<CpdiShape<1>>;
template class SolidMpm<CpdiShape<2>>;
template class SolidMpm<CpdiShape<3>>;
template class SolidMpm<AxisymmetricCpdiShape<1>>;
template class SolidMpm<AxisymmetricCpdiShape<2>>;

}  // namespace tushar::mpm::solid

namespace tushar::modules {

using namespace mpm;
using namespace mpm::solid;

simulation::Catalogue mpm_solid_cpdi() {
  defineSolids(Interpolator::cpdi, makeSolids<CpdiShape>, makeAxisymmetricSolids<AxisymmetricCpdiShape>);
  return {};
}

}  // namespace tushar::modules
