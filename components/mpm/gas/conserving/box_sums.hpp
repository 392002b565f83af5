#pragma once

#include <array>

#include "components/mpm/gas/conserving/footprint.hpp"

namespace tushar::mpm::gas::conserving {

/// N sums over boxes at the nodes (More = 1) or cells (More = 0) around rows of cells; sumOverBoxes fills them.
///
/// A sum is bitwise the same for all patches and for the mirror image, because the order of its additions depends only
/// on which cell contains which particles: the particles of a cell are added first, then the cells of a row, then the
/// rows of a plane, then the planes. Of the cells (or rows, or planes) that can reach a node, the two at the same
/// distance on either side are added to each other, and then these pairs, from the outermost inwards. The sum over more
/// than two particles of a cell includes the rounding errors of its additions, so that their order does not matter
/// unless the sum lies within about 1e-32 of the midpoint of two floating-point numbers.
///
/// Only rows and planes that wait for others are stored. They use the same memory in turn, which stays in the caches of
/// the processor.
template <int D, std::size_t N, int More>
class BoxSums {
  static constexpr int overhang = Footprint<D>::overhang;
  /// Number of nodes or cells along an axis that the particles of a cell can reach.
  static constexpr std::size_t width = static_cast<std::size_t>(Footprint<D>::most + More);
  static constexpr std::size_t pairs = (width + 1) / 2;
  static constexpr std::size_t rows = D == 1 ? 1 : D == 2 ? width : width * width;
  static constexpr std::size_t slots = 4;  ///< number of rows, or planes, that wait at the same time
  static_assert(D == 1 || width <= slots);
  /// Number of earlier blocks of a row whose particles reach nodes of the block that is completed.
  static constexpr std::size_t history = (width - 2) / Lanes::count + 1;

 public:
  static constexpr int more = More;
  /// What the particles of a block bring to a row of nodes or cells around it: each lane has a cell, and brings to
  /// `width` nodes or cells, the lowest first. A block is Lanes::count consecutive cells of a row.
  using Terms = std::array<Lanes, width>;

  /// `visited` contains the rows of cells that are visited, each of which has `blocks` blocks.
  BoxSums(const Box& visited, int blocks)
      : first_(visited.lower[0] - overhang),
        length_(static_cast<std::size_t>(blocks * Lanes::count)),
        size_(N * length_),
        finished_(AlignedNumbers(size_)) {
    for (int d = 1; d < D; ++d) lowest_[d] = visited.lower[d];
    if constexpr (D > 1) waiting_[0] = AlignedNumbers(rows / width * slots * pairs * size_);
    if constexpr (D > 2) {
      along_ = static_cast<std::size_t>(visited.extent(1));
      waiting_[1] = AlignedNumbers(slots * pairs * along_ * size_);
    }
  }

  void beginRow(const Index<D>& row) {
    for (int d = 1; d < D; ++d) row_[static_cast<std::size_t>(d)] = static_cast<std::size_t>(row[d] - lowest_[d]);
    emptyFor_.fill(history);
    for (std::size_t k = 0; k < rows; ++k) ways_[k] = wayOf(k);
    past_.fill({});
    place_ = 0;
  }
  /// Begins the next block of a row; `most` is the largest number of particles in one of its cells.
  void beginBlock(int most) {
    most_ = most;
    isReached_.fill(false);
    if (most > 2) lost_.fill({});
  }
  /// Adds terms to the sums in a row of nodes or cells, the k-th of the footprints of a batch: `terms(n)` to sum n.
  /// Lanes without a particle bring 0.
  template <class TermsOf>
  [[gnu::always_inline]] void add(const Footprint<D>& footprint, const Index<D>& k, TermsOf&& terms) {
    const std::size_t row = rowOf(footprint, k);
    const bool isFirst = !isReached_[row];
    isReached_[row] = true;
    if (most_ <= 1) {
      bring(ways_[row], terms);
    } else {
      for (std::size_t n = 0; n < N; ++n)
        if (isFirst)
          sums_[row][n] = terms(n);
        else
          addMore(row, n, terms(n));
    }
  }
  /// The index among Terms of the lowest node or cell of a footprint.
  static std::size_t firstOf(const Footprint<D>& footprint) {
    return static_cast<std::size_t>(overhang - footprint.along[0].below);
  }
  /// The terms of nodes or cells that footprints of known extent overlap, and 0 for the others.
  template <int Below, int Cells>
  [[gnu::always_inline]] static Terms widened(Extent<Below, Cells>, const std::array<Lanes, Cells + More>& terms) {
    constexpr std::size_t first = overhang - Below;
    Terms all;
#pragma GCC unroll 8
    for (std::size_t k = 0; k < width; ++k) all[k] = k >= first && k < first + terms.size() ? terms[k - first] : 0;
    return all;
  }
  /// Completes a block.
  void endBlock() {
    for (std::size_t row = 0; row < rows; ++row) {
      if (!isReached_[row] || most_ > 1) bringRest(row);
      emptyFor_[row] = isReached_[row] ? 0 : emptyFor_[row] + 1;
    }
    place_ += Lanes::count;
    oldest_ = oldest_ + 1 == history ? 0 : oldest_ + 1;
  }

  /// The sums at a node or cell and its neighbours along the first axis, in the row that is complete.
  Lanes readRow(std::size_t n, const Index<D>& index) const {
    return Lanes::at(&finished_[n * length_ + static_cast<std::size_t>(index[0] - first_)]);
  }

 private:
  /// What the sum of a visited row does in a row of nodes or cells around it, and that of a row in a plane: begins or
  /// continues a pair of terms, or completes the sum of all pairs, because no later row or plane reaches it.
  enum class Role { begins, continues, completes };
  static constexpr Role roleOf(std::size_t k) {
    return k == 0 ? Role::completes : k < width / 2 ? Role::continues : Role::begins;
  }
  /// Where the terms of a row around the block go, at the beginning of the row. It is the same for all N sums.
  struct Way {
    std::array<std::array<Lanes, width - 1>*, history> past;  ///< terms of the row in earlier blocks
    double *inRow = nullptr, *inPlane = nullptr;              ///< the pairs of terms to which the visited row belongs
    Role ofRow = Role::completes, ofPlane = Role::completes;
  };
  /// Number of the row around a cell that contains the node or cell k of a footprint.
  static std::size_t rowOf(const Footprint<D>& footprint, const Index<D>& k) {
    std::size_t row = 0;
    for (int d = D - 1; d > 0; --d) {
      const int below = footprint.along[static_cast<std::size_t>(d)].below;
      row = row * width + static_cast<std::size_t>(k[d] + overhang - below);
    }
    return row;
  }
  /// Adds the terms of one of several particles of each cell.
  [[gnu::noinline]] void addMore(std::size_t row, std::size_t n, const Terms& terms) {
    for (std::size_t k = 0; k < width; ++k) {
      Lanes term = terms[k];
      if (most_ > 2) {
        data::addExactly(sums_[row][n][k], term);
        lost_[row][n][k] += term;
      } else {
        sums_[row][n][k] += term;
      }
    }
  }
  /// Brings the sums over several particles of each cell or, where there are none, only what earlier blocks bring.
  void bringRest(std::size_t row) {
    const Way& way = ways_[row];
    if (isReached_[row]) {
      if (most_ > 2)
        for (std::size_t n = 0; n < N; ++n)
          for (std::size_t k = 0; k < width; ++k) sums_[row][n][k] += lost_[row][n][k];
      bring(
          way, [&](std::size_t n) __attribute__((always_inline))->const Terms& { return sums_[row][n]; });
    } else if (emptyFor_[row] < history) {
      const Terms none{};
      bring(
          way, [&](std::size_t) __attribute__((always_inline))->const Terms& { return none; });
    } else if (D == 1 || way.ofRow != Role::continues) {
      pass(
          way, [](std::size_t) __attribute__((always_inline)) { return Lanes(0); });
    }
  }

  /// The way of a row from the beginning of the visited row on.
  Way wayOf(std::size_t row) {
    Way way;
    for (std::size_t ago = 0; ago < history; ++ago) way.past[ago] = past_[ago * rows + row].data();
    if constexpr (D > 1) {
      const std::size_t along = row % width, plane = row / width;
      way.ofRow = roleOf(along);
      way.inRow = &waiting_[0][((plane * slots + (row_[1] + along) % slots) * pairs + pairOf(along)) * size_];
      if constexpr (D > 2) {
        way.ofPlane = roleOf(plane);
        way.inPlane = &waiting_[1][(((row_[2] + plane) % slots * pairs + pairOf(plane)) * along_ + row_[1]) * size_];
      }
    }
    return way;
  }
  static constexpr std::size_t pairOf(std::size_t k) { return std::min(k, width - 1 - k); }

  /// Adds up the terms of this block and of earlier ones at the same nodes, the first of which is the lowest that the
  /// first cell of this block reaches.
  template <class TermsOf>
  [[gnu::always_inline]] void bring(const Way& way, TermsOf&& terms) {
    static_assert(pairs == 2 || pairs == 3);
    pass(
        way, [&](std::size_t n) __attribute__((always_inline)) {
          const Terms all = terms(n);
          Lanes sum = pairOfCells<0>(way, n, all) + pairOfCells<1>(way, n, all);
          if constexpr (pairs > 2) sum += pairOfCells<2>(way, n, all);
          for (std::size_t k = 1; k < width; ++k) past(way, 0)[n][k - 1] = all[k];
          return sum;
        });
  }
  /// The terms of a row in earlier blocks, the oldest first.
  [[gnu::always_inline]] std::array<Lanes, width - 1>* past(const Way& way, std::size_t number) const {
    if constexpr (history == 1) return way.past[0];
    return way.past[(oldest_ + number) % history];
  }
  template <std::size_t pair>
  [[gnu::always_inline]] Lanes pairOfCells(const Way& way, std::size_t n, const Terms& terms) const {
    constexpr std::size_t other = width - 1 - pair;
    if constexpr (pair == other)
      return fromCells<pair>(way, n, terms);
    else
      return fromCells<pair>(way, n, terms) + fromCells<other>(way, n, terms);
  }
  /// What cells bring to the k-th of the nodes or cells that they reach: each lane has that of the cell k before its
  /// own.
  template <std::size_t k>
  [[gnu::always_inline]] Lanes fromCells(const Way& way, std::size_t n, const Terms& terms) const {
    constexpr std::size_t back = (k + Lanes::count - 1) / Lanes::count, start = back * Lanes::count - k;
    const auto ofBlock = [&](std::size_t ago) __attribute__((always_inline))->const Lanes& {
      return ago == 0 ? terms[k] : past(way, history - ago)[n][k - 1];
    };
    if constexpr (start == 0)
      return ofBlock(back);
    else
      return window<static_cast<int>(start)>(ofBlock(back), ofBlock(back - 1));
  }

  /// Adds what the visited row brings to a row around it, value(n) to sum n, and, if the sum over its rows is then
  /// complete, to a plane.
  template <class Value>
  [[gnu::always_inline]] void pass(const Way& way, Value&& value) {
    const auto inPlane = [&](std::size_t n, const Lanes& sum) __attribute__((always_inline)) {
      if constexpr (D > 2) {
        double* at = way.inPlane + place_ + n * length_;
        if (way.ofPlane == Role::begins) return sum.copyTo(at);
        if (way.ofPlane == Role::continues) return (Lanes::at(at) + sum).copyTo(at);
        return finish(n, completed(at, along_ * size_, sum));
      }
      finish(n, sum);
    };
    if constexpr (D == 1) {
      eachSum([&](std::size_t n) __attribute__((always_inline)) { inPlane(n, value(n)); });
    } else {
      double* at = way.inRow + place_;
      if (way.ofRow == Role::begins)
        eachSum([&](std::size_t n) __attribute__((always_inline)) { value(n).copyTo(at + n * length_); });
      else if (way.ofRow == Role::continues)
        eachSum([&](std::size_t n) __attribute__((always_inline)) {
          (Lanes::at(at + n * length_) + value(n)).copyTo(at + n * length_);
        });
      else
        eachSum([&](std::size_t n)
                    __attribute__((always_inline)) { inPlane(n, completed(at + n * length_, size_, value(n))); });
    }
  }
  template <class Visit>
  [[gnu::always_inline]] static void eachSum(Visit&& visit) {
#pragma GCC unroll 4
    for (std::size_t n = 0; n < N; ++n) visit(n);
  }
  /// The sum over the pairs of terms that wait in a row or plane, `distance` apart, the first at `waiting`.
  [[gnu::always_inline]] static Lanes completed(const double* waiting, std::size_t distance, Lanes value) {
    for (std::size_t pair = 0; pair < pairs; ++pair) value += Lanes::at(waiting + pair * distance);
    return value;
  }
  [[gnu::always_inline]] void finish(std::size_t n, const Lanes& sum) {
    (sum + 0).copyTo(&finished_[n * length_ + place_]);  // never -0
  }

  int first_;           ///< index of the first node or cell of a row
  std::size_t length_;  ///< length of a row in memory
  std::size_t size_;    ///< numbers of a row, with all sums
  /// Terms of the rows in earlier blocks, in turn; not of the lowest nodes, which no later cell shares.
  std::array<std::array<std::array<Lanes, width - 1>, N>, history * rows> past_;
  std::array<std::array<Terms, N>, rows> sums_, lost_;  ///< over several particles per cell, and their rounding errors
  std::array<bool, rows> isReached_;                    ///< whether a particle of the block has reached a row
  std::array<std::size_t, rows> emptyFor_;              ///< number of blocks in which no particle has reached a row
  std::size_t oldest_ = 0, place_ = 0;  ///< the oldest of the past blocks; place of the block in its row
  int most_ = 0;
  Index<D> lowest_;
  std::array<std::size_t, D> row_{};  ///< distance of the visited row from the first one along the axes but the first
  std::size_t along_ = 0;             ///< number of rows of a plane
  std::array<AlignedNumbers, 2> waiting_;
  AlignedNumbers finished_;
  std::array<Way, rows> ways_;
};

/// The rows of cells whose particles reach the cells of a patch or, with `more` = 1, also its nodes. Rows are counted
/// where the grid has none, too, because sums wait for them.
template <int D>
struct RowsAround {
  Box rows;    ///< each row ends behind its last block
  int blocks;  ///< number of blocks in a row
  Box cells;   ///< the cells whose particles are known

  RowsAround(const Patch& patch, const Box& known, int more) : cells(known) {
    constexpr int overhang = Footprint<D>::overhang;
    rows = patch.cells().grown(overhang + more, D);
    rows.lower[0] = known.lower[0];
    blocks = (patch.cells().upper[0] + more + overhang - known.lower[0] + Lanes::count - 1) / Lanes::count;
    rows.upper[0] = rows.lower[0] + blocks * Lanes::count;
  }
  /// Number of cells of a row whose particles are known.
  int known(const Index<D>& row) const {
    bool isKnown = true;
    for (int d = 1; d < D; ++d) isKnown = isKnown && row[d] >= cells.lower[d] && row[d] < cells.upper[d];
    return isKnown ? cells.extent(0) : 0;
  }
};

/// Calls `visit(batch)` for batches that contain each particle once, and `finish(row)` as soon as the sums are complete
/// in the row of nodes or cells `row`, also for some rows around the patch.
template <int D, class T, class Visit, class Finish, class... Sums>
[[gnu::always_inline]] inline void sumOverBoxes(const RowsAround<D>& around, const ParticleView<T>& view, Visit&& visit,
                                                Finish&& finish, Sums&... sums) {
  forEach<D>(around.rows.rowStarts(), [&](const Index<D>& row) {
    (sums.beginRow(row), ...);
    int left = around.known(row);
    const data::ParticleRange* ranges = left > 0 ? view.set().row(row) : nullptr;
    Index<D> cell = row;
    for (int block = 0; block < around.blocks; ++block, cell[0] += Lanes::count, left -= Lanes::count) {
      RangesOfCells particles(ranges, std::clamp(left, 0, Lanes::count));
      ranges += left > Lanes::count ? Lanes::count : 0;
      const int most = particles.most();
      (sums.beginBlock(most), ...);
      for (int k = 0; k < most; ++k, particles.first += 1) {
        const auto used = __builtin_convertvector(particles.first < particles.last, Lanes::Mask);
        visit(Batch<D>(cell, particles.first, used));
      }
      (sums.endBlock(), ...);
    }
    Index<D> complete = row;
    for (int d = 1; d < D; ++d) complete[d] -= Footprint<D>::overhang;
    finish(complete);
  });
}

/// Calls `visit(part)` for the parts of a row of a box; the row may lie outside the box.
template <int D, class Visit>
[[gnu::always_inline]] inline void forEachPartOfRow(Box box, const Index<D>& row, Visit&& visit) {
  for (int d = 1; d < D; ++d) {
    if (row[d] < box.lower[d] || row[d] >= box.upper[d]) return;
    box.lower[d] = row[d];
    box.upper[d] = row[d] + 1;
  }
  forEachRowPart<D>(box, visit);
}

}  // namespace tushar::mpm::gas::conserving
