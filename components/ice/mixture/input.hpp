#pragma once

#include "components/ice/gas_schemas.hpp"

namespace tushar::ice {

/// Checks a scene with several gases, and reports features that are not available with them. In the scene, `solids`
/// materials come before the gases.
void checkMixture(const std::vector<GasMaterial>& materials, const input::Element& root, const GasScene& scene,
                  int solids, input::Diagnostics& diagnostics);

}  // namespace tushar::ice
