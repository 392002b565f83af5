#pragma once

#include <vector>

#include "components/ice/gas_schemas.hpp"
#include "components/ice/scalar.hpp"

namespace tushar::ice {

/// Checks the conditions of a scene at the sides of the grid, for gases that follow `solids` bodies and for scalars
/// that they carry. `isBinary`: the gas is a mixture of two, whose mass fraction is the scalar f.
void checkConditions(const input::Element& root, int solids, const std::vector<GasMaterial>& gases,
                     const std::vector<ScalarSettings>& scalars, bool isBinary, input::Diagnostics& diagnostics);

}  // namespace tushar::ice
