#include "components/mpm/gas/input.hpp"
#include "components/mpm/gas/paper/mass_projection.hpp"
#include "components/mpm/mpm.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_gas() {
  mpm::define(mpm::Method::gas, mpm::gas::kind());
  return {{}, {mpm::gas::paper::massProjectionKind()}};
}

}  // namespace tushar::modules
