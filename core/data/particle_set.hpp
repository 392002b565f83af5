#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "core/base/function_ref.hpp"
#include "core/base/vec.hpp"
#include "core/data/row_table.hpp"
#include "core/data/touched_rows.hpp"
#include "core/grid/box.hpp"
#include "core/grid/patch.hpp"

namespace tushar::data {

/// Indices of the particles of one cell, in the order of their ids.
struct ParticleRange {
  int first = 0, last = 0;

  int size() const { return last - first; }
  bool empty() const { return first == last; }

  struct Iterator {
    int at;
    int operator*() const { return at; }
    Iterator& operator++() {
      ++at;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at != other.at; }
  };
  Iterator begin() const { return {first}; }
  Iterator end() const { return {last}; }
};

/// Consecutive ghosts of a patch that are copies of particles, from another rank or from a periodic image.
struct GhostRun {
  int patch, first, count;  ///< patch of the original particles, index of the first one, and their number
  Index3 shift;             ///< shift of the periodic image [cells]; zero for particles on the grid itself
  int to;                   ///< index of the first copy, counted from the first particle of the patch
};

/// The particles of one material on a patch, cell by cell.
///
/// Particles have indices, which count positions in memory from the patch's first particle. The patch's own particles
/// have indices from 0 on, sorted by (cell, id). Ghosts are particles of other patches in the cells around this patch.
/// A ghost whose patch is on the same rank is not copied: it is read in the memory of its own patch, which lies before
/// this patch's memory (negative indices) or behind it. Only ghosts from other ranks and periodic images are copies.
/// Sums run over cells in lexicographic order and, within a cell, by id, so they do not depend on which patch owns a
/// particle.
class ParticleSet {
 public:
  /// Makes the set empty, for a patch and the cells of the grid within `reach` of it.
  void reset(const grid::Patch& patch, int reach);

  int owned() const { return owned_; }
  /// Whether `place` is the index of a particle that the patch owns or may read.
  bool covers(int place) const {
    return (place >= 0 && place < owned_) || (place >= ghosts_.first && place < ghosts_.last);
  }
  bool hasNone() const { return owned_ == 0 && ghosts_.empty(); }
  const grid::Box& ownedCells() const { return owned_cells_; }
  /// The cells of the patch and the cells within reach of it.
  const grid::Box& cells() const { return cells_; }

  template <int D>
  ParticleRange in(const Index<D>& cell) const {
    return ranges_[rowOf(cell)][cell[0] - cells_.lower[0]];
  }
  /// For writing.
  template <int D>
  ParticleRange& at(const Index<D>& cell) {
    return ranges_.open(rowOf(cell))[cell[0] - cells_.lower[0]];
  }
  /// Assigns the particles of a cell; takes no memory for rows without particles.
  template <int D>
  void put(const Index<D>& cell, const ParticleRange& range) {
    if (!range.empty() || ranges_.isOpen(rowOf(cell))) at(cell) = range;
  }

  template <int D>
  using VisitCell = FunctionRef<void(const Index<D>& cell, const ParticleRange& particles)>;
  /// Calls `visit(cell, particles)` for the cells of a box that contain particles, in lexicographic order.
  template <int D>
  void forEachOccupied(const grid::Box& box, VisitCell<D> visit) const;
  /// Calls `visit(cell, particles)` as forEachOccupied does, but is compiled together with `visit`: for visits that are
  /// so short that a function call for each cell would cost more than they do.
  template <int D, class Visit>
  void forEachOccupiedInline(const grid::Box& box, const Visit& visit) const;

  /// A range of cells along the first axis, from `first` up to but excluding `last`.
  struct Span {
    int first, last;

    bool empty() const { return first >= last; }
  };
  /// The smallest part of the row from `cell` to `end` that contains all cells with particles.
  template <int D>
  Span occupied(const Index<D>& cell, int end) const {
    const Span span = spans_[rowOf(cell)];
    const int first = std::max(span.first, cell[0]);
    return {first, std::max(std::min(span.last, end), first)};
  }

  /// The rows of nodes that particles of cells() touch: the nodes of their cells and `ghost` layers around them, along
  /// the first `dimension` axes. The rows are found by the first call, which several threads must not make at the same
  /// time.
  const TouchedRows& touched(int ghost, int dimension) const;

  /// The particle ranges of consecutive cells along the first axis, starting at `cell`.
  template <int D>
  const ParticleRange* row(const Index<D>& cell) const {
    return ranges_[rowOf(cell)] + (cell[0] - cells_.lower[0]);
  }
  /// The particle ranges of consecutive cells along the first axis, starting at `cell`, for writing; valid until the
  /// next row is opened.
  ParticleRange* openRow(const Index3& cell) { return ranges_.open(rowOf(cell)) + (cell[0] - cells_.lower[0]); }
  /// Makes space for about as many rows with particles as `other` has.
  void makeSpaceFor(const ParticleSet& other) { ranges_.makeSpaceFor(other.ranges_); }

  /// Declares that the particles of all cells of the patch have been added, `count` in total.
  void setOwned(int count);
  /// Declares that all particles of the patch in the row starting at `first` have been added.
  void closeRow(const Index3& first);
  /// Like setOwned, after closeRow has been called for every row that has particles.
  void setOwnedOfClosedRows(int count) { owned_ = count; }

  /// Makes space in `box` for ghosts: for the particles of a set that `shift` moves there. Afterwards several threads
  /// may call addGhosts, each for its own set, and ghosts added in `box` move no ranges in memory.
  void openGhostRows(const grid::Box& box, const ParticleSet& theirs, const Index3& shift = {});
  /// Declares those particles of the set `theirs` that are in `box` as ghosts; `theirs` begins `offset` positions after
  /// this set in memory.
  void addGhosts(const grid::Box& box, const ParticleSet& theirs, int offset);
  /// Declares copies, which are stored from index `to` on, as the ghosts of `cell`. The originals are the particles
  /// `there` of the patch `patch`, in its cell `cell - shift`. If they are particles of this set, which then has a
  /// periodic image of itself, openGhostRows must have made space before.
  void addCopies(const Index3& cell, int patch, const ParticleRange& there, const Index3& shift, int to);
  const std::vector<GhostRun>& ghostRuns() const { return ghost_runs_; }
  bool hasGhosts() const { return has_ghosts_; }
  void markGhosts() { has_ghosts_ = true; }
  /// Marks the ghosts as out of date, because the particles of their patches have changed.
  void forgetGhosts();

 private:
  template <int D>
  std::size_t rowOf(const Index<D>& cell) const {
    std::ptrdiff_t row = 0;
    if constexpr (D > 1) row += cell[1] - cells_.lower[1];
    if constexpr (D > 2) row += std::ptrdiff_t{cell[2] - cells_.lower[2]} * cells_.extent(1);
    return row;
  }

  /// Removes the particles of the cells of a row, except those in `kept`.
  void empty(std::size_t row, const Span& kept);
  /// Extends the occupied part of a row by `cells`, and the range of ghosts by `places`.
  void widen(std::size_t row, const Span& cells, const ParticleRange& places);

  grid::Box owned_cells_, cells_;
  RowTable<ParticleRange> ranges_;
  /// For each row along the first axis, the smallest part that contains all cells with particles.
  std::vector<Span> spans_;
  std::vector<Span> own_spans_;  ///< the same, for the patch's own particles only
  std::vector<GhostRun> ghost_runs_;
  ParticleRange ghosts_;  ///< range from the first ghost to the end of the last one
  int owned_ = 0;
  bool has_ghosts_ = false;
  /// Touched rows for each number of ghost layers, up to the largest that was requested.
  mutable std::map<int, TouchedRows> touched_;
};

template <int D, class Visit>
void ParticleSet::forEachOccupiedInline(const grid::Box& box, const Visit& visit) const {
  if (hasNone()) return;
  grid::forEach<D>(box.rowStarts(), [&](Index<D> cell) {
    const Span span = occupied(cell, box.upper[0]);
    cell[0] = span.first;
    const ParticleRange* range = row(cell);
    for (; cell[0] < span.last; ++cell[0], ++range)
      if (!range->empty()) visit(std::as_const(cell), *range);
  });
}

}  // namespace tushar::data
