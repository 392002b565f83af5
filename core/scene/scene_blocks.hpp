#pragma once

#include <string>

#include "core/grid/level.hpp"
#include "core/scene/scene.hpp"

namespace tushar::scene {

/// A tag of `Regridder` if it is given, otherwise another place for messages.
input::Element regridderTagOr(const AmrSettings& amr, const std::string& tag, const input::Element& other);

/// Chooses the number of cells of a block along each axis in use: those of the scene, or the nearest that divide the
/// grid and that its tasks allow. `level` is the tag of the first Level, `coarsest` its cells.
void chooseBlocks(const input::Element& level, const AmrSettings& amr, const grid::Level& coarsest,
                  grid::Refinement& refinement, input::Diagnostics& diagnostics);

}  // namespace tushar::scene
