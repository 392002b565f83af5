#include "components/mpm/solid/explicit/schedule.hpp"

namespace tushar::mpm::solid {

template class SolidMpm<QuadraticShape<1>>;
template class SolidMpm<QuadraticShape<2>>;
template class SolidMpm<QuadraticShape<3>>;

}  // namespace tushar::mpm::solid
