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

/// Consecutive ghosts of a patch that are copies of particles: of another rank, or of a periodic image.
struct GhostRun {
  int patch, first, count;  ///< where the copied particles are
  Index3 shift;             ///< shift in cells of their periodic image; zero on the grid itself
  int to;                   ///< place of the first copy, counted from the first particle of the patch
};

/// The particles of one material on a patch, cell by cell.
///
/// Places count from the first particle of the patch. Owned particles stand there, sorted by (cell, id). Ghosts, those
/// of the cells around the patch that belong to other patches, stand where their own patch has them, if that is on the
/// same rank: before (places below 0) or behind. Only those of other ranks and of periodic images are copies. The index
/// of cells brings all into one order: sums run cell by cell in lexicographic order and by id within a cell, so they do
/// not depend on who owns what.
class ParticleSet {
 public:
  /// An empty set over a patch and the cells of the grid within `reach` of it.
  void reset(const grid::Patch& patch, int reach);

  int owned() const { return owned_; }
  /// Whether there is a particle at this place that the patch owns or reads.
  bool covers(int place) const {
    return (place >= 0 && place < owned_) || (place >= ghosts_.first && place < ghosts_.last);
  }
  bool hasNone() const { return owned_ == 0 && ghosts_.empty(); }
  const grid::Box& ownedCells() const { return owned_cells_; }
  /// The patch's cells and those within reach of it.
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

  /// Coordinates of cells along the first axis, from `first` up to but excluding `last`.
  struct Span {
    int first, last;

    bool empty() const { return first >= last; }
  };
  /// The part of the row from `cell` to `end` outside which no cell contains particles.
  template <int D>
  Span occupied(const Index<D>& cell, int end) const {
    const Span span = spans_[rowOf(cell)];
    const int first = std::max(span.first, cell[0]);
    return {first, std::max(std::min(span.last, end), first)};
  }

  /// The rows of nodes that particles of cells() touch: the nodes of their cells and `ghost` layers around them, along
  /// the first `dimension` axes. They are found on first use, which must not be by several threads at once.
  const TouchedRows& touched(int ghost, int dimension) const;

  /// The ranges of consecutive cells along the first axis, from `cell` on.
  template <int D>
  const ParticleRange* row(const Index<D>& cell) const {
    return ranges_[rowOf(cell)] + (cell[0] - cells_.lower[0]);
  }
  /// The same for writing; valid until the next row is opened.
  ParticleRange* openRow(const Index3& cell) { return ranges_.open(rowOf(cell)) + (cell[0] - cells_.lower[0]); }
  /// Makes space for the rows of a set that is about as large.
  void makeSpaceFor(const ParticleSet& other) { ranges_.makeSpaceFor(other.ranges_); }

  /// Marks the particles of all cells of the patch as complete, `count` in total.
  void setOwned(int count);
  /// Marks the particles of the cells of the patch in the row starting with `first` as complete.
  void closeRow(const Index3& first);
  /// Like setOwned, after closeRow has been called for every row that has particles.
  void setOwnedOfClosedRows(int count) { owned_ = count; }

  /// Makes space for the particles of another set in `box` as ghosts. Afterwards several threads may call addGhosts,
  /// each for its own set.
  void openGhostRows(const grid::Box& box, const ParticleSet& theirs);
  /// Declares the particles of another set in `box` as ghosts; that set begins `offset` places after this one.
  void addGhosts(const grid::Box& box, const ParticleSet& theirs, int offset);
  /// Declares copies, from place `to` on, as the ghosts of a cell: of the particles `there` in cell - shift on `patch`.
  void addCopies(const Index3& cell, int patch, const ParticleRange& there, const Index3& shift, int to);
  const std::vector<GhostRun>& ghostRuns() const { return ghost_runs_; }
  bool hasGhosts() const { return has_ghosts_; }
  void markGhosts() { has_ghosts_ = true; }
  /// Marks the ghosts as out of date, because their patches have other particles now.
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
  /// Notes ghosts from `first` up to `last` in a row of cells.
  void widen(std::size_t row, const Span& cells, const ParticleRange& places);

  grid::Box owned_cells_, cells_;
  RowTable<ParticleRange> ranges_;
  std::vector<Span> spans_;  ///< for each row along the first axis, the part outside which no cell contains particles
  std::vector<Span> own_spans_;  ///< the same for the patch's own particles
  std::vector<GhostRun> ghost_runs_;
  ParticleRange ghosts_;  ///< from the first place of a ghost to the end of the last
  int owned_ = 0;
  bool has_ghosts_ = false;
  mutable std::map<int, TouchedRows> touched_;  ///< by distance beyond the cells, up to the largest that was requested
};

}  // namespace tushar::data
