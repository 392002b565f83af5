#include "core/grid/patch.hpp"

#include "core/grid/level.hpp"

namespace tushar::grid {

Box Patch::nodes() const {
  Box nodes = cells_.nodes(level_->dimension());
  for (int d = 0; d < level_->dimension(); ++d) {
    if (isAtBoundary(d, 0)) nodes.lower[d] -= level_->domain().nodesBeyond;
    if (isAtBoundary(d, 1)) nodes.upper[d] += level_->domain().nodesBeyond;
  }
  return nodes;
}

Box Patch::cellsWithin(int width) const { return level_->clipCells(cells_.grown(width, level_->dimension())); }

Box Patch::nodesWithin(int width) const { return level_->clipNodes(nodes().grown(width, level_->dimension())); }

bool Patch::isAtBoundary(int kernelAxis, int side) const {
  if (level_->isPeriodic(kernelAxis)) return false;
  return side == 0 ? cells_.lower[kernelAxis] == 0 : cells_.upper[kernelAxis] == level_->cells().upper[kernelAxis];
}

Box Patch::faceNodes(int kernelAxis, int side) const {
  Box face = nodes();
  face.lower[kernelAxis] = side == 0 ? cells_.lower[kernelAxis] : cells_.upper[kernelAxis];
  face.upper[kernelAxis] = face.lower[kernelAxis] + 1;
  return face;
}

Box Patch::nodesBeyond(int kernelAxis, int side) const {
  Box beyond = nodes();
  if (side == 0)
    beyond.upper[kernelAxis] = cells_.lower[kernelAxis];
  else
    beyond.lower[kernelAxis] = cells_.upper[kernelAxis] + 1;
  return beyond;
}

}  // namespace tushar::grid
