#include "components/mpm/solid/explicit/schedule.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<CubicShape<1>>;
template class SolidMpm<CubicShape<2>>;
template class SolidMpm<CubicShape<3>>;

}  // namespace tushar::mpm::solid
