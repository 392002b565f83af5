#pragma once

#include <string>

#include "core/grid/level.hpp"
#include "core/scene/scene.hpp"

namespace tushar::scene {

/// Returns the tag to which messages refer: the tag `tag` of `Regridder` if the scene gives it, otherwise `other`.
input::Element regridderTagOr(const AmrSettings& amr, const std::string& tag, const input::Element& other);

/// Chooses the number of cells of a block along each axis in use: the numbers in the scene or, if these are not
/// possible, the nearest ones that divide the grid and that the tasks allow. `level` is the tag of the first Level,
/// `coarsest` its cells.
void chooseBlocks(const input::Element& level, const AmrSettings& amr, const grid::Level& coarsest,
                  grid::Refinement& refinement, input::Diagnostics& diagnostics);

}  // namespace tushar::scene
