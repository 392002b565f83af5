#include "components/mpm/gas/conserving/conserving_mpm.hpp"
#include "components/mpm/gas/conserving/input.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::modules {

simulation::Catalogue mpm_gas_conserving() {
  using namespace mpm::gas;
  conserving::makeConservingMpm =
      simulation::makeByDimension<conserving::ConservingMpm, conserving::ConservingGasDynamics, std::vector<Gas>>;
  return {};
}

}  // namespace tushar::modules
