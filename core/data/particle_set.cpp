#include "core/data/particle_set.hpp"

#include "core/grid/level.hpp"

namespace tushar::data {

void ParticleSet::reset(const grid::Patch& patch, int reach) {
  owned_cells_ = patch.cells();
  cells_ = patch.cellsWithin(reach);
  stride_ = {{1, cells_.extent(0), cells_.extent(0) * cells_.extent(1)}};
  ranges_.assign(cells_.size(), {});
  owned_ = total_ = 0;
  ghost_runs_.clear();
  has_ghosts_ = false;
}

void ParticleSet::addGhostCell(const Index3& cell, int patch, const ParticleRange& there, const Index3& shift) {
  at(cell) = {total_, total_ + there.size()};
  total_ += there.size();
  if (there.empty()) return;
  GhostRun* last = ghost_runs_.empty() ? nullptr : &ghost_runs_.back();
  if (last && last->patch == patch && last->shift == shift && last->first + last->count == there.first)
    last->count += there.size();
  else
    ghost_runs_.push_back({patch, there.first, there.size(), shift});
}

}  // namespace tushar::data
