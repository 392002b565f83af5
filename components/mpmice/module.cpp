#include "components/mpmice/input.hpp"

namespace tushar::modules {

simulation::Catalogue mpmice() { return {{tushar::mpmice::kind(false), tushar::mpmice::kind(true)}, {}}; }

}  // namespace tushar::modules
