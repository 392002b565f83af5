#include "components/mpm/shapes/cpdi_shape.hpp"
#include "components/mpm/solid/explicit/schedule.hpp"
#include "components/mpm/solid/transfer/cpdi_transfer.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<CpdiShape<1>>;
template class SolidMpm<CpdiShape<2>>;
template class SolidMpm<CpdiShape<3>>;

}  // namespace tushar::mpm::solid
