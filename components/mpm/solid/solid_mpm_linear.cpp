#include "components/mpm/solid/schedule.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<LinearShape<1>>;
template class SolidMpm<LinearShape<2>>;
template class SolidMpm<LinearShape<3>>;

}  // namespace tushar::mpm::solid
