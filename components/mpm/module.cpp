#include "components/mpm/mpm.hpp"

namespace tushar::modules {

simulation::Catalogue mpm() { return {{mpm::kind()}, {}}; }

}  // namespace tushar::modules
