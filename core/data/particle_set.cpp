#include "core/data/particle_set.hpp"

#include "core/grid/level.hpp"

namespace tushar::data {

void ParticleSet::reset(const grid::Patch& patch, int reach) {
  owned_cells_ = patch.cells();
  cells_ = patch.cellsWithin(reach);
  stride_ = {{1, cells_.extent(0), cells_.extent(0) * cells_.extent(1)}};
  ranges_.assign(cells_.size(), {});
  owned_ = total_ = 0;
  has_ghosts_ = false;
}

}  // namespace tushar::data
