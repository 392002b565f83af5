#include "core/data/particle_set.hpp"

#include "core/grid/level.hpp"

namespace tushar::data {

void ParticleSet::reset(const grid::Patch& patch, int reach) {
  const Span none{patch.cellsWithin(reach).upper[0], patch.cellsWithin(reach).lower[0]};
  if (owned_cells_ == patch.cells() && cells_ == patch.cellsWithin(reach)) {
    for (std::size_t row = 0; row < spans_.size(); ++row) empty(row);
  } else {
    owned_cells_ = patch.cells();
    cells_ = patch.cellsWithin(reach);
    stride_ = {{1, cells_.extent(0), cells_.extent(0) * cells_.extent(1)}};
    ranges_.assign(cells_.size(), {});
  }
  spans_.assign(cells_.rows(), none);
  owned_ = total_ = 0;
  ghost_runs_.clear();
  has_ghosts_ = false;
}

void ParticleSet::empty(std::size_t row) {
  const Span span = spans_[row];
  if (span.empty()) return;
  const auto start = static_cast<std::size_t>(span.first - cells_.lower[0]);
  std::fill_n(&ranges_[row * static_cast<std::size_t>(cells_.extent(0)) + start], span.last - span.first, ParticleRange{});
}

void ParticleSet::setOwned(int count) {
  setOwnedOfClosedRows(count);
  grid::forEach<3>(owned_cells_.rowStarts(), [&](const Index3& first) { closeRow(first); });
}

void ParticleSet::closeRow(const Index3& cell) {
  const ParticleRange* range = row(cell);
  int first = 0, last = owned_cells_.extent(0);
  while (first < last && range[first].empty()) ++first;
  while (last > first && range[last - 1].empty()) --last;
  if (first < last) spans_[rowOf(cell)] = {cell[0] + first, cell[0] + last};
}

void ParticleSet::addGhostCell(const Index3& cell, int patch, const ParticleRange& there, const Index3& shift) {
  at(cell) = {total_, total_ + there.size()};
  total_ += there.size();
  if (there.empty()) return;
  Span& span = spans_[rowOf(cell)];
  span = {std::min(span.first, cell[0]), std::max(span.last, cell[0] + 1)};
  GhostRun* last = ghost_runs_.empty() ? nullptr : &ghost_runs_.back();
  if (last && last->patch == patch && last->shift == shift && last->first + last->count == there.first)
    last->count += there.size();
  else
    ghost_runs_.push_back({patch, there.first, there.size(), shift});
}

}  // namespace tushar::data
