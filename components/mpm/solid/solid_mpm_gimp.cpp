#include "components/mpm/solid/schedule.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<GimpShape<1>>;
template class SolidMpm<GimpShape<2>>;
template class SolidMpm<GimpShape<3>>;

}  // namespace tushar::mpm::solid
