#include "components/mpm/solid/schedule.hpp"
#include "components/mpm/solid/shapes/cpdi_shape.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<CpdiShape<1>>;
template class SolidMpm<CpdiShape<2>>;
template class SolidMpm<CpdiShape<3>>;

}  // namespace tushar::mpm::solid
