#include "core/solvers/numbering.hpp"

#include "core/data/views.hpp"

namespace tushar::solvers {

CellNumbering::CellNumbering(const grid::Grid& grid) : grid_(&grid) {
  if (grid.levels() > 1) {
    for (const grid::Patch& patch : grid.patches()) owned_ += static_cast<int>(patch.cells().size());
    first_ = grid.share().ranks == 1 ? 0 : grid.tiling().cellsBefore(grid.firstPatch());
  } else if (grid.share().ranks > 1) {
    numberOwnPatches();
  } else {
    owned_ = static_cast<int>(grid.level().cells().size());
  }
}

void CellNumbering::numberOwnPatches() {
  std::vector<int> firstOf{0};
  for (int id = 0; id < grid_->patchCount(); ++id)
    firstOf.push_back(firstOf.back() + static_cast<int>(grid_->patch(id).cells().size()));
  for (const grid::Patch& patch : grid_->patches())
    grid::forEach<3>(patch.cells(),
                     [&](const Index3& cell) { numbers_[grid_->level().cellNumber<3>(cell)] = owned_++; });
  for (const grid::Patch& patch : grid_->patches()) numberGhosts(patch, firstOf);
}

void CellNumbering::numberGhosts(const grid::Patch& patch, const std::vector<int>& firstOf) {
  const grid::Level& level = grid_->level();
  for (int d = 0; d < level.dimension(); ++d)
    for (const int side : {0, 1}) {
      grid::Box beyond = patch.cells();
      if (side == 0)
        beyond.upper[d] = beyond.lower[d]--;
      else
        beyond.lower[d] = beyond.upper[d]++;
      grid::forEach<3>(level.clipCells(beyond), [&](const Index3& next) {
        const Index3 cell = level.wrapped(next);
        const int number = owned_ + static_cast<int>(ghosts_.size());
        if (!numbers_.emplace(level.cellNumber<3>(cell), number).second) return;
        const grid::Patch other = grid_->patchOf(cell, level.number());
        ghosts_.push_back(firstOf[other.id()] + static_cast<int>(other.cells().offset(cell)));
      });
    }
}

std::uint64_t CellNumbering::numberAmongAll(int level, const Index3& cell) const {
  if (!last_ || last_->level != level || !last_->cells.contains(cell)) last_ = runAround(level, cell);
  return last_->first + last_->cells.offset(cell);
}

CellNumbering::Run CellNumbering::runAround(int level, const Index3& cell) const {
  const grid::BlockTiling& tiling = grid_->tiling();
  const grid::Tile tile = tiling.tileOf(level, cell);
  if (tile.id < 0) throw data::AccessError("a cell that is refined, or part of a coarser one, has no index");
  if (grid_->share().ranks > 1) return {level, tile.cells, tiling.cellsBefore(tile.id)};
  grid::BlockId block{level, {}};
  for (int d = 0; d < 3; ++d) block.at[d] = cell[d] / tiling.blockCells()[d];
  const grid::Box cells = grid::cellsOf(block, tiling.blockCells(), grid_->dimension());
  return {level, cells, std::uint64_t(tiling.tree().placeOf(block)) * cells.size()};
}

}  // namespace tushar::solvers
