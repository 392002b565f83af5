#include "core/solvers/numbering.hpp"

namespace tushar::solvers {

void CellNumbering::numberOwnPatches() {
  const grid::Grid& grid = level_->grid();
  std::vector<int> firstOf{0};
  for (int id = 0; id < grid.patchCount(); ++id)
    firstOf.push_back(firstOf.back() + static_cast<int>(grid.patch(id).cells().size()));
  for (const grid::Patch& patch : grid.patches())
    grid::forEach<3>(patch.cells(), [&](const Index3& cell) { numbers_[level_->cellNumber<3>(cell)] = owned_++; });
  for (const grid::Patch& patch : grid.patches()) numberGhosts(patch, firstOf);
}

void CellNumbering::numberGhosts(const grid::Patch& patch, const std::vector<int>& firstOf) {
  for (int d = 0; d < level_->dimension(); ++d)
    for (const int side : {0, 1}) {
      grid::Box beyond = patch.cells();
      if (side == 0)
        beyond.upper[d] = beyond.lower[d]--;
      else
        beyond.lower[d] = beyond.upper[d]++;
      grid::forEach<3>(level_->clipCells(beyond), [&](const Index3& next) {
        const Index3 cell = level_->wrapped(next);
        const int number = owned_ + static_cast<int>(ghosts_.size());
        if (!numbers_.emplace(level_->cellNumber<3>(cell), number).second) return;
        const grid::Patch other = level_->grid().patchOf(cell, level_->number());
        ghosts_.push_back(firstOf[other.id()] + static_cast<int>(other.cells().offset(cell)));
      });
    }
}

}  // namespace tushar::solvers
