#pragma once

#include <vector>

#include "components/ice/gas_schemas.hpp"

namespace tushar::ice {

/// The index of the material to which a condition applies; -1 for all materials. It is also -1 for an invalid id, which
/// is reported when the grid is read.
int materialOf(const input::Element& condition);

/// Gives a gas the law of a material of the scene.
void takeLaw(const GasMaterial& material, euler::Gas& gas);

/// Reads the materials into a scene whose other settings are known: one gas, a mixture of two gases, or several gases.
/// In the scene, `solids` bodies come before them.
void readMaterials(const std::vector<GasMaterial>& materials, const input::Element& root, int solids, GasScene& scene,
                   input::Diagnostics& diagnostics);

}  // namespace tushar::ice
