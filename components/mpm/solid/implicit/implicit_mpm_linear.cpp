#include "components/mpm/solid/implicit/schedule.hpp"

namespace tushar::mpm::solid::implicit {

template class ImplicitSystem<LinearShape<1>>;
template class ImplicitSystem<LinearShape<2>>;
template class ImplicitSystem<LinearShape<3>>;
template class ImplicitMpm<LinearShape<1>>;
template class ImplicitMpm<LinearShape<2>>;
template class ImplicitMpm<LinearShape<3>>;

}  // namespace tushar::mpm::solid::implicit
