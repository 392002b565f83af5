#include "core/grid/patch.hpp"

#include "core/grid/level.hpp"

namespace tushar::grid {

Box Patch::nodes() const { return cells_.nodes(level_->dimension()); }

Box Patch::cellsWithin(int width) const { return level_->clipCells(cells_.grown(width, level_->dimension())); }

Box Patch::nodesWithin(int width) const { return level_->clipNodes(nodes().grown(width, level_->dimension())); }

bool Patch::isAtBoundary(int kernelAxis, int side) const {
  if (level_->isPeriodic(kernelAxis)) return false;
  return side == 0 ? cells_.lower[kernelAxis] == 0 : cells_.upper[kernelAxis] == level_->cells().upper[kernelAxis];
}

Box Patch::faceNodes(int kernelAxis, int side) const {
  Box face = nodes();
  if (side == 0)
    face.upper[kernelAxis] = face.lower[kernelAxis] + 1;
  else
    face.lower[kernelAxis] = face.upper[kernelAxis] - 1;
  return face;
}

}  // namespace tushar::grid
