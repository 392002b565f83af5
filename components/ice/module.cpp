#include "components/ice/ice.hpp"

namespace tushar::modules {

simulation::Catalogue ice() { return {{tushar::ice::kind()}, {}}; }

}  // namespace tushar::modules
