#include "components/analysis/exact_solution.hpp"
#include "components/analysis/particle_extract.hpp"
#include "components/analysis/slice.hpp"

namespace tushar::modules {

simulation::Catalogue analysis() {
  using namespace tushar::analysis;
  return {{}, {exactSolutionKind(), particleExtractKind(), sliceKind()}};
}

}  // namespace tushar::modules
