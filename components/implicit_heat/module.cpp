#include "components/implicit_heat/implicit_heat.hpp"

namespace tushar::modules {

simulation::Catalogue implicit_heat() { return {{tushar::implicit_heat::kind()}, {}}; }

}  // namespace tushar::modules
