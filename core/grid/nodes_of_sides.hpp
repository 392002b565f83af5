#pragma once

#include "core/grid/level.hpp"
#include "core/grid/patch.hpp"

// The nodes of a patch on which the conditions of a side act: on the side of the grid, if the patch touches it, and on
// the inner sides of a level of several boxes.

namespace tushar::grid {

/// Whether a patch may have nodes on a side; costs less than to look up the conditions of the side.
inline bool mayTouchSide(const Patch& patch, int kernelAxis, int side) {
  return patch.isAtBoundary(kernelAxis, side) || patch.level().boxes();
}

/// Calls `visit(nodes)` for boxes of nodes on a side, which have no nodes in common.
template <class Visit>
void forEachBoxOnSide(const Patch& patch, int kernelAxis, int side, Visit&& visit) {
  if (patch.isAtBoundary(kernelAxis, side)) visit(patch.faceNodes(kernelAxis, side));
  const SeveralBoxes* boxes = patch.level().boxes();
  if (!boxes) return;
  const Box own = patch.nodes();
  for (const SeveralBoxes::Nodes& nodes : boxes->onSide(kernelAxis, side))
    if (const Box box = nodes.box.intersect(own); !box.empty()) visit(box);
}

/// Calls `visit(nodes, face)` for boxes of nodes beyond a side; `face` is the index of the nodes on the side along the
/// axis.
template <class Visit>
void forEachBoxBeyond(const Patch& patch, int kernelAxis, int side, Visit&& visit) {
  const Box& cells = patch.cells();
  if (patch.isAtBoundary(kernelAxis, side))
    visit(patch.nodesBeyond(kernelAxis, side), side == 0 ? cells.lower[kernelAxis] : cells.upper[kernelAxis]);
  const SeveralBoxes* boxes = patch.level().boxes();
  if (!boxes) return;
  const Box own = patch.nodes();
  for (const SeveralBoxes::Nodes& nodes : boxes->beyondSide(kernelAxis, side))
    if (const Box box = nodes.box.intersect(own); !box.empty()) visit(box, nodes.plane);
}

/// Whether the conditions of a side act on a node of the patch because it lies on the side.
template <int D>
bool isOnSide(const Patch& patch, int kernelAxis, int side, const Index<D>& node) {
  bool is = false;
  forEachBoxOnSide(patch, kernelAxis, side, [&](const Box& nodes) { is = is || nodes.template contains<D>(node); });
  return is;
}

}  // namespace tushar::grid
