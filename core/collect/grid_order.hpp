#pragma once

#include <memory>

#include "core/collect/rows.hpp"
#include "core/grid/block_tiling.hpp"
#include "core/grid/grid.hpp"

namespace tushar::collect {

/// A layout-independent order of the cells or nodes of a grid. On a single level, the first axis is fastest. On several
/// levels, the order goes box by box, from the coarsest level to the finest, and along Morton's curve within a level.
class GridOrder {
 public:
  /// The order of the cells or nodes of a box, for a single level.
  explicit GridOrder(const grid::Box& all) : all_(all) {}
  /// The order of the cells of several levels, in boxes of up to `most` cells along each axis or, if `most` is 0, block
  /// by block along the curve. `windows[level]` is the box of cells of a level that are part of the order; if `windows`
  /// is empty, all cells are.
  GridOrder(const grid::Grid& grid, int most, std::vector<grid::Box> windows = {});

  std::size_t size() const { return boxes_ ? size_ : all_.size(); }
  /// The cells or nodes of a patch that are part of the order.
  grid::Box givenBy(const grid::Box& own) const { return boxes_ ? own : own.intersect(all_); }
  /// Calls `visit(position in the order, first cell or node, count)` for each piece of a row of `box` that is
  /// contiguous in the order. The pieces come box by box along the curve, hence from left to right within a row.
  template <class Visit>
  void forEachRow(int level, const grid::Box& box, Visit&& visit) const {
    if (!boxes_) return rowsOf(0, all_, box.intersect(all_), visit);
    for (const grid::Tile& tile : boxes_->overlapping(level, box)) {
      const grid::Box cells = shown(tile);
      rowsOf(before_[tile.id], cells, box.intersect(cells), visit);
    }
  }

  /// The non-empty boxes of all levels, in this order.
  std::vector<grid::Tile> boxes() const;

 private:
  template <class Visit>
  static void rowsOf(std::size_t before, const grid::Box& all, const grid::Box& part, Visit&& visit) {
    collect::forEachRow(part, [&](const Index3& first) { visit(before + all.offset(first), first, part.extent(0)); });
  }

  grid::Box shown(const grid::Tile& tile) const {
    return windows_.empty() ? tile.cells : tile.cells.intersect(windows_[tile.level]);
  }

  grid::Box all_;
  bool is_by_level_ = false;
  std::shared_ptr<const grid::BlockTiling> boxes_;
  std::vector<std::size_t> before_;  ///< position of the first cell of each box
  std::vector<grid::Box> windows_;   ///< window of each level
  std::size_t size_ = 0;
};

/// The order of all cells or nodes on which a variable has values; on several levels, in boxes that suit file readers.
GridOrder orderOf(const grid::Grid& grid, bool isNode);

/// The order in a checkpoint. On several levels, it goes block by block; on one level, it includes the nodes outside
/// the grid.
GridOrder orderOfState(const grid::Grid& grid, bool isNode);

/// Largest number of cells along an axis of a box in a file.
inline constexpr int mostCellsOfBox = 64;

}  // namespace tushar::collect
