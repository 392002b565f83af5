#include "components/mpm/solid/implicit/schedule.hpp"

namespace tushar::mpm::solid::implicit {

template class ImplicitSystem<GimpShape<1>>;
template class ImplicitSystem<GimpShape<2>>;
template class ImplicitSystem<GimpShape<3>>;
template class ImplicitMpm<GimpShape<1>>;
template class ImplicitMpm<GimpShape<2>>;
template class ImplicitMpm<GimpShape<3>>;

}  // namespace tushar::mpm::solid::implicit
