#include "core/collect/grid_order.hpp"

#include <algorithm>

namespace tushar::collect {

GridOrder::GridOrder(const grid::Grid& grid, int most, std::vector<grid::Box> windows)
    : is_by_level_(most > 0), windows_(std::move(windows)) {
  Index3 cells = grid.blockCells();
  for (int d = 0; d < grid.dimension(); ++d) cells[d] *= std::max(1, most / cells[d]);
  boxes_ = std::make_shared<const grid::BlockTiling>(grid.tree(), grid.blockCells(), cells);
  before_.resize(boxes_->count());
  for (const grid::Tile& tile : boxes()) {
    before_[tile.id] = size_;
    size_ += tile.cells.size();
  }
}

std::vector<grid::Tile> GridOrder::boxes() const {
  std::vector<grid::Tile> tiles;
  for (int id = 0; id < boxes_->count(); ++id) {
    tiles.push_back(boxes_->tile(id));
    tiles.back().cells = shown(tiles.back());
    if (tiles.back().cells.empty()) tiles.pop_back();
  }
  if (is_by_level_)
    std::stable_sort(tiles.begin(), tiles.end(),
                     [](const grid::Tile& a, const grid::Tile& b) { return a.level < b.level; });
  return tiles;
}

GridOrder orderOf(const grid::Grid& grid, bool isNode) {
  if (grid.levels() > 1) return {grid, mostCellsOfBox};
  return GridOrder(isNode ? grid.level().nodesOfCells() : grid.level().cells());
}

GridOrder orderOfState(const grid::Grid& grid, bool isNode) {
  if (grid.levels() > 1) return {grid, 0};
  return GridOrder(isNode ? grid.level().nodes() : grid.level().cells());
}

}  // namespace tushar::collect
