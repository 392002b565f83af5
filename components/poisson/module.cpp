#include "components/poisson/poisson.hpp"

namespace tushar::modules {

simulation::Catalogue poisson() { return {{tushar::poisson::kind()}, {}}; }

}  // namespace tushar::modules
