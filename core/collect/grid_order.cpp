#include "core/collect/grid_order.hpp"

#include <algorithm>

namespace tushar::collect {

GridOrder::GridOrder(const grid::Grid& grid, int most) {
  Index3 cells = grid.blockCells();
  for (int d = 0; d < grid.dimension(); ++d) cells[d] *= std::max(1, most / cells[d]);
  boxes_ = std::make_shared<const grid::BlockTiling>(grid.tree(), grid.blockCells(), cells);
}

GridOrder orderOf(const grid::Grid& grid, bool isNode) {
  if (grid.levels() > 1) return {grid, mostCellsOfBox};
  return GridOrder(isNode ? grid.level().nodesOfCells() : grid.level().cells());
}

}  // namespace tushar::collect
