#include "components/mpm/solid/explicit/schedule.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<LinearShape<1>>;
template class SolidMpm<LinearShape<2>>;
template class SolidMpm<LinearShape<3>>;
template class SolidMpm<AxisymmetricLinearShape<1>>;
template class SolidMpm<AxisymmetricLinearShape<2>>;

}  // namespace tushar::mpm::solid
