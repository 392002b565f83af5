#pragma once

#include "components/ice/gas_schemas.hpp"

namespace tushar::ice {

/// What is wrong with a scene of several gases, or cannot be with them. They are numbered after `solids` materials.
void checkMixture(const std::vector<GasMaterial>& materials, const input::Element& root, const GasScene& scene,
                  int solids, input::Diagnostics& diagnostics);

}  // namespace tushar::ice
