#include "components/reference/modules.hpp"

namespace tushar::modules {

simulation::Catalogue reference() {
  using namespace tushar::reference;
  return {{},
          {exactRiemannKind(), simpleWaveKind(), isentropicVortexKind(), greshoKind(), nohKind(), sedovKind(),
           tabulatedKind()}};
}

}  // namespace tushar::modules
