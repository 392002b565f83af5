#pragma once

#include "core/grid/box.hpp"

namespace tushar::grid {

class Level;

/// A box of cells of the grid, the unit of work of a task.
///
/// A patch has all nodes of its cells. Nodes on a face between two patches belong to both; both patches complete their
/// values from the same particles in the same order, so the values are bitwise equal.
class Patch {
 public:
  Patch(const Level& level, int id, const Box& cells) : level_(&level), id_(id), cells_(cells) {}

  int id() const { return id_; }
  const Level& level() const { return *level_; }
  const Box& cells() const { return cells_; }
  /// The nodes of the patch's cells and, if the patch touches sides of the grid, the nodes outside these sides.
  Box nodes() const;
  /// Cells within `width` of the patch that lie on the grid or, along periodic axes, on its periodic images.
  Box cellsWithin(int width) const;
  /// Nodes within `width` of the patch's nodes that lie on the grid or, along periodic axes, on its periodic images.
  Box nodesWithin(int width) const;
  /// Whether a side (0: lower, 1: upper) along a kernel axis is a side of the grid; always false along a periodic axis.
  bool isAtBoundary(int kernelAxis, int side) const;
  /// The patch's nodes on one of its sides.
  Box faceNodes(int kernelAxis, int side) const;
  /// The nodes outside the grid beyond one of the patch's sides.
  Box nodesBeyond(int kernelAxis, int side) const;

 private:
  const Level* level_;
  int id_;
  Box cells_;
};

}  // namespace tushar::grid
