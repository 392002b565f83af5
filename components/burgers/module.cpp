#include "components/burgers/burgers.hpp"
#include "components/burgers/burgers_wave.hpp"

namespace tushar::modules {

simulation::Catalogue burgers() { return {{tushar::burgers::kind()}, {tushar::burgers::waveKind()}}; }

}  // namespace tushar::modules
