#include "components/mpm/mpm.hpp"
#include "components/mpm/solid/analysis/energy_budget.hpp"
#include "components/mpm/solid/analysis/manufactured_error.hpp"
#include "components/mpm/solid/explicit/input.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_solid() {
  mpm::define(mpm::Method::solid, mpm::solid::kind());
  return {{}, {mpm::solid::energyBudgetKind(), mpm::solid::manufacturedErrorKind()}};
}

}  // namespace tushar::modules
