#include "components/analysis/control_vol_fluxes.hpp"
#include "components/analysis/exact_solution.hpp"
#include "components/analysis/first_law_thermo.hpp"
#include "components/analysis/line_extract.hpp"
#include "components/analysis/min_max.hpp"
#include "components/analysis/particle_extract.hpp"
#include "components/analysis/plane_average.hpp"
#include "components/analysis/plane_extract.hpp"
#include "components/analysis/slice.hpp"
#include "components/analysis/statistics.hpp"
#include "components/analysis/vorticity.hpp"

namespace tushar::modules {

simulation::Catalogue analysis() {
  using namespace tushar::analysis;
  return {{},
          {controlVolFluxesKind(), exactSolutionKind(), firstLawThermoKind(), lineExtractKind(), minMaxKind(),
           particleExtractKind(), planeAverageKind(), planeExtractKind(), sliceKind(), statisticsKind(),
           turbulentFluxesKind(), vorticityKind()}};
}

}  // namespace tushar::modules
