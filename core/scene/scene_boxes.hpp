#pragma once

#include "core/scene/scene_levels.hpp"

namespace tushar::scene {

/// Reads the boxes of the first Level into `domain`: their bounding box with its cells and, unless they fill it, the
/// boxes themselves. They have cells of one size, share faces of cells, and do not overlap.
void readBoxes(const input::Element& level, const LevelSection& read, grid::Domain& domain,
               input::Diagnostics& diagnostics);

/// The request for patches in all boxes of a Level: several boxes are divided together, into as many patches as they
/// request in all.
GridBox patchesOfBoxes(const input::Element& level, const LevelSection& read, input::Diagnostics& diagnostics);

}  // namespace tushar::scene
