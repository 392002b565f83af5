#include "components/mpm/mpm.hpp"
#include "components/mpm/solid/implicit/input.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_implicit() {
  const simulation::ComponentKind kind = mpm::solid::implicit::implicitKind();
  mpm::define(mpm::Method::implicitSolid, {kind.read, kind.describe, kind.forms, kind.nodesBeyond});
  return {{kind}, {}};
}

}  // namespace tushar::modules
