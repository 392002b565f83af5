#pragma once

#include <vector>

#include "components/ice/gas_schemas.hpp"

namespace tushar::ice {

/// The number of the material for which a condition holds; -1 for all, or if the id is invalid, which the grid reports.
int materialOf(const input::Element& condition);

/// Takes the materials of a scene, whose other settings it has: one gas, one that is a mixture of two, or several. They
/// are numbered after `solids` bodies.
void readMaterials(const std::vector<GasMaterial>& materials, const input::Element& root, int solids, GasScene& scene,
                   input::Diagnostics& diagnostics);

}  // namespace tushar::ice
