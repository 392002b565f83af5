#include "components/mpm/solid/explicit/schedule.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<GimpShape<1>>;
template class SolidMpm<GimpShape<2>>;
template class SolidMpm<GimpShape<3>>;
template class SolidMpm<AxisymmetricGimpShape<1>>;
template class SolidMpm<AxisymmetricGimpShape<2>>;

}  // namespace tushar::mpm::solid
