#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grid/box.hpp"

namespace tushar::grid {

/// The shape of a level that consists of several boxes of cells of one size.
///
/// Such a level is counted like a level of one box, the bounding box of all, and is divided into patches like it. Its
/// cells outside the boxes contain nothing. An inner side consists of the faces between cells inside and cells outside;
/// like a side of the bounding box, it is named after the axis and the direction in which the material ends: `x+` is a
/// side beyond which there is nothing to the right.
///
/// Conditions of a side act on the nodes of its inner sides and, for wide shape functions, on one layer of nodes beyond
/// them, as on a side of the bounding box. They do not act on the nodes of re-entrant edges, around which material can
/// flow from one box into another: there both walls would hold what slides along either. For the same reason, nodes
/// diagonally beyond such an edge, which belong to neither wall, have no condition.
class SeveralBoxes {
 public:
  /// `boxes` do not overlap; `all` is their bounding box. `layers` is the number of layers of nodes beyond each side: 0
  /// or 1.
  SeveralBoxes(std::vector<Box> boxes, const Box& all, int dimension, int layers);

  /// Whether a cell is inside one of the boxes.
  bool contains(const Index3& cell) const;
  /// Whether a node belongs to a cell inside one of the boxes.
  bool isNode(const Index3& node) const;
  /// Number of cells of all boxes.
  std::uint64_t size() const;

  /// Nodes on which the conditions of a side act; `plane` is their index along the axis of the side, or that of the
  /// face beyond which they lie.
  struct Nodes {
    Box box;
    int plane;
  };
  /// Nodes on the inner sides along an axis; `side` is 0 if the material ends downwards, 1 if upwards.
  const std::vector<Nodes>& onSide(int axis, int side) const { return on_[2 * axis + side]; }
  /// Nodes in the layer beyond these sides.
  const std::vector<Nodes>& beyondSide(int axis, int side) const { return beyond_[2 * axis + side]; }

  /// Moves cuts between patches along an axis, which are in ascending order, to the nearest nodes at which they may
  /// be: a patch that contains a node beyond an inner side must contain the nodes that it mirrors. Removes those that
  /// meet.
  std::vector<int> allowedCuts(int axis, const std::vector<int>& cuts) const;

 private:
  /// A range of nodes along an axis whose surroundings are the same.
  struct Range {
    int lower, upper;
  };
  std::vector<Range> alike(int axis) const;
  void findSides(int axis, int side);
  template <class IsOne>
  std::vector<Nodes> collect(int axis, int shift, const IsOne& isOne) const;
  bool isOnSide(int axis, int side, const Index3& node) const;
  bool isOnSideOrPast(int axis, int side, const Index3& node) const;
  bool isBeyond(int axis, int side, const Index3& node) const;
  bool mayCut(int axis, int node) const;

  std::vector<Box> boxes_;
  Box all_;
  int dimension_, layers_;
  std::array<std::vector<Nodes>, 6> on_, beyond_;
};

}  // namespace tushar::grid
