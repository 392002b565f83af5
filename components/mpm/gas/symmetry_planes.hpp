#pragma once

#include "core/core.hpp"

namespace tushar::mpm::gas {

/// Sets the normal component of a node field to 0 at symmetry planes, so that nothing moves through them.
template <int D>
void stopAtSymmetryPlanes(const Patch& patch, NodeView<Vec<D>> field) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (patch.isAtBoundary(d, side) && patch.level().isSymmetry(d, side))
        forEach<D>(patch.faceNodes(d, side), [&](const Index<D>& node) { field[node][d] = 0; });
}

}  // namespace tushar::mpm::gas
