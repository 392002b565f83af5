#pragma once

#include "components/ice/gas_schemas.hpp"

namespace tushar::ice {

/// What is wrong with a scene of several gases, or cannot be with them.
void checkMixture(const std::vector<GasMaterial>& materials, const input::Element& root, const GasScene& scene,
                  input::Diagnostics& diagnostics);

}  // namespace tushar::ice
