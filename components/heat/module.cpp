#include "components/heat/heat.hpp"

namespace tushar::modules {

simulation::Catalogue heat() { return {{tushar::heat::kind()}, {}}; }

}  // namespace tushar::modules
