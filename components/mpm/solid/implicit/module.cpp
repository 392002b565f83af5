#include "components/mpm/mpm.hpp"
#include "components/mpm/solid/implicit/input.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_implicit() {
  const simulation::ComponentKind kind = mpm::solid::implicit::implicitKind();
  mpm::define(mpm::Method::implicitSolid, kind);
  return {{kind}, {}};
}

}  // namespace tushar::modules
