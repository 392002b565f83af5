#include "components/mpm/solid/implicit/schedule.hpp"

namespace tushar::mpm::solid::implicit {

template class ImplicitSystem<AxisymmetricLinearShape<1>>;
template class ImplicitSystem<AxisymmetricLinearShape<2>>;
template class ImplicitSystem<AxisymmetricGimpShape<1>>;
template class ImplicitSystem<AxisymmetricGimpShape<2>>;
template class ImplicitMpm<AxisymmetricLinearShape<1>>;
template class ImplicitMpm<AxisymmetricLinearShape<2>>;
template class ImplicitMpm<AxisymmetricGimpShape<1>>;
template class ImplicitMpm<AxisymmetricGimpShape<2>>;

}  // namespace tushar::mpm::solid::implicit
