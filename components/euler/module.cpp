#include "components/euler/input.hpp"

namespace tushar::modules {

simulation::Catalogue euler() { return {{tushar::euler::kind()}, {}}; }

}  // namespace tushar::modules
