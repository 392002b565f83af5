#pragma once

#include <cstdint>
#include <vector>

#include "core/grid/box.hpp"

namespace tushar::grid {

/// A patch of a tiling: its index, its level and its cells, as indices on that level.
struct Tile {
  int id;
  int level;
  Box cells;
};

/// The division of the cells of a grid into patches, which are numbered along a curve. Every rank stores the whole
/// division.
class Tiling {
 public:
  virtual ~Tiling() = default;

  /// Number of patches.
  virtual int count() const = 0;
  virtual Tile tile(int id) const = 0;
  /// The patch that contains a cell of a level; its id is -1 if the cell is refined or part of a coarser cell.
  virtual Tile tileOf(int level, const Index3& cell) const = 0;
  /// The patches of a level that contain cells of a box; the whole box must lie on the grid.
  virtual std::vector<Tile> overlapping(int level, const Box& cells) const = 0;

  /// Number of cells of all patches together.
  virtual std::uint64_t cells() const = 0;
  /// Number of cells in all patches before a given one.
  virtual std::uint64_t cellsBefore(int id) const = 0;
  /// The first patch before which there are at least `cells` cells.
  virtual int patchAfter(std::uint64_t cells) const = 0;
};

}  // namespace tushar::grid
