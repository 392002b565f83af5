#pragma once

#include <optional>
#include <vector>

#include "core/grid/box.hpp"

// Checks of the boxes of a level of several boxes (see SeveralBoxes).

namespace tushar::grid {

/// What keeps boxes of cells from forming one level.
struct BoxConflict {
  enum class Kind {
    overlap,  ///< the boxes have cells in common
    apart,    ///< no chain of boxes that share faces of cells leads from one to the other
    close     ///< they come within two cells of one another with cells outside in between, so that wide shape functions
              ///< of particles in one of them would reach into the other
  };
  Kind kind;
  std::size_t box, other;  ///< indices of the boxes
};

/// The smallest box that contains all boxes.
Box boundingBoxOf(const std::vector<Box>& boxes);
/// Whether boxes that do not overlap fill their bounding box.
bool fillTheirBoundingBox(const std::vector<Box>& boxes);
/// The first conflict between boxes of cells; none if they form a level.
std::optional<BoxConflict> conflictOf(const std::vector<Box>& boxes);

}  // namespace tushar::grid
