#include "core/data/particle_set.hpp"

#include "core/grid/level.hpp"

namespace tushar::data {

void ParticleSet::reset(const grid::Patch& patch, int reach) {
  const grid::Box within = patch.cellsWithin(reach);
  const Span none{within.upper[0], within.lower[0]};
  touched_.clear();
  owned_cells_ = patch.cells();
  cells_ = within;
  ranges_.reset(cells_.rows(), static_cast<std::size_t>(cells_.extent(0)));
  spans_.assign(cells_.rows(), none);
  own_spans_ = spans_;
  owned_ = 0;
  ghosts_ = {};
  ghost_runs_.clear();
  has_ghosts_ = false;
}

void ParticleSet::empty(std::size_t row, const Span& kept) {
  const auto clear = [&](int from, int to) {
    if (from < to) std::fill_n(ranges_.open(row) + (from - cells_.lower[0]), to - from, ParticleRange{});
  };
  const Span span = spans_[row];
  if (kept.empty()) return clear(span.first, span.last);
  clear(span.first, kept.first);
  clear(kept.last, span.last);
}

void ParticleSet::setOwned(int count) {
  setOwnedOfClosedRows(count);
  grid::forEach<3>(owned_cells_.rowStarts(), [&](const Index3& first) { closeRow(first); });
}

template <int D>
void ParticleSet::forEachOccupied(const grid::Box& box, VisitCell<D> visit) const {
  forEachOccupiedInline<D>(box, visit);
}
template void ParticleSet::forEachOccupied(const grid::Box&, VisitCell<1>) const;
template void ParticleSet::forEachOccupied(const grid::Box&, VisitCell<2>) const;
template void ParticleSet::forEachOccupied(const grid::Box&, VisitCell<3>) const;

const TouchedRows& ParticleSet::touched(int ghost, int dimension) const {
  static const TouchedRows none;
  if (hasNone()) return none;
  const auto [rows, isNew] = touched_.try_emplace(ghost);
  if (isNew) rows->second = {*this, cells_, ghost, cells_.nodes(dimension).grown(ghost, dimension), dimension};
  return rows->second;
}

void ParticleSet::closeRow(const Index3& cell) {
  touched_.clear();
  if (!ranges_.isOpen(rowOf(cell))) return;
  const ParticleRange* range = row(cell);
  int first = 0, last = owned_cells_.extent(0);
  while (first < last && range[first].empty()) ++first;
  while (last > first && range[last - 1].empty()) --last;
  if (first < last) spans_[rowOf(cell)] = own_spans_[rowOf(cell)] = {cell[0] + first, cell[0] + last};
}

void ParticleSet::widen(std::size_t row, const Span& cells, const ParticleRange& places) {
  Span& span = spans_[row];
  span = {std::min(span.first, cells.first), std::max(span.last, cells.last)};
  ghosts_ = ghosts_.empty() ? places
                            : ParticleRange{std::min(ghosts_.first, places.first), std::max(ghosts_.last, places.last)};
}

void ParticleSet::openGhostRows(const grid::Box& box, const ParticleSet& theirs, const Index3& shift) {
  if (theirs.owned_ > 0)
    grid::forEach<3>(box.rowStarts(), [&](const Index3& cell) {
      const Span span = theirs.own_spans_[theirs.rowOf(cell - shift)];
      if (span.first + shift[0] < box.upper[0] && span.last + shift[0] > cell[0]) ranges_.open(rowOf(cell));
    });
}

void ParticleSet::addGhosts(const grid::Box& box, const ParticleSet& theirs, int offset) {
  if (theirs.owned_ == 0) return;
  touched_.clear();
  grid::forEach<3>(box.rowStarts(), [&](Index3 cell) {
    Span span = theirs.own_spans_[theirs.rowOf(cell)];
    span = {std::max(span.first, cell[0]), std::min(span.last, box.upper[0])};
    if (span.empty()) return;
    cell[0] = span.first;
    const ParticleRange* from = theirs.row(cell);
    ParticleRange* to = openRow(cell);
    for (int k = 0; k < span.last - span.first; ++k) to[k] = {from[k].first + offset, from[k].last + offset};
    widen(rowOf(cell), span, {to[0].first, to[span.last - span.first - 1].last});
  });
}

void ParticleSet::addCopies(const Index3& cell, int patch, const ParticleRange& there, const Index3& shift, int to) {
  if (there.empty()) return;
  at(cell) = {to, to + there.size()};
  touched_.clear();
  widen(rowOf(cell), {cell[0], cell[0] + 1}, at(cell));
  GhostRun* last = ghost_runs_.empty() ? nullptr : &ghost_runs_.back();
  if (last && last->patch == patch && last->shift == shift && last->first + last->count == there.first &&
      last->to + last->count == to)
    last->count += there.size();
  else
    ghost_runs_.push_back({patch, there.first, there.size(), shift, to});
}

void ParticleSet::forgetGhosts() {
  if (!has_ghosts_) return;
  const std::size_t widened = ghosts_.empty() ? 0 : spans_.size();
  for (std::size_t row = 0; row < widened; ++row) {
    if (spans_[row].first == own_spans_[row].first && spans_[row].last == own_spans_[row].last) continue;
    empty(row, own_spans_[row]);
    spans_[row] = own_spans_[row];
  }
  ghosts_ = {};
  ghost_runs_.clear();
  has_ghosts_ = false;
  touched_.clear();
}

}  // namespace tushar::data
