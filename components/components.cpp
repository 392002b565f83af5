#include "components/components.hpp"

#include "components/analysis/exact_solution.hpp"
#include "components/analysis/particle_extract.hpp"
#include "components/burgers/burgers.hpp"
#include "components/burgers/burgers_wave.hpp"
#include "components/euler/input.hpp"
#include "components/heat/heat.hpp"
#include "components/mpm/gas/paper/mass_projection.hpp"
#include "components/mpm/mpm.hpp"
#include "components/mpm/solid/analysis/energy_budget.hpp"
#include "components/mpm/solid/analysis/manufactured_error.hpp"
#include "components/mpm/solid/implicit/input.hpp"
#include "components/poisson/poisson.hpp"
#include "components/reference/modules.hpp"

namespace tushar {

simulation::Catalogue catalogue() {
  return {
      {
          burgers::kind(),
          euler::kind(),
          heat::kind(),
          mpm::kind(),
          mpm::solid::implicit::implicitKind(),
          poisson::kind(),
      },
      {
          burgers::waveKind(),
          mpm::gas::paper::massProjectionKind(),
          mpm::solid::energyBudgetKind(),
          mpm::solid::manufacturedErrorKind(),
          reference::exactRiemannKind(),
          reference::simpleWaveKind(),
          reference::isentropicVortexKind(),
          reference::greshoKind(),
          reference::nohKind(),
          reference::sedovKind(),
          reference::tabulatedKind(),
          analysis::exactSolutionKind(),
          analysis::particleExtractKind(),
      },
  };
}

}  // namespace tushar
