#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "components/mpmice/settings.hpp"

namespace tushar::mpmice {

/// Number of layers of cells around a cell whose free volumes affect the step of the cell.
inline constexpr int nearLayers = 2;

/// The index of a cell in a box, row by row.
template <int D>
[[gnu::always_inline]] inline std::size_t offsetIn(const Box& box, const Index<D>& cell) {
  std::ptrdiff_t offset = cell[D - 1] - box.lower[D - 1];
  for (int d = D - 2; d >= 0; --d) offset = offset * box.extent(d) + (cell[d] - box.lower[d]);
  return static_cast<std::size_t>(offset);
}

/// A truth value for each cell of a box, as one byte, which is 0 or 1.
template <int D>
class CellMarks {
 public:
  explicit CellMarks(const Box& box) : box_(box), marks_(box.size(), 0) {}

  const Box& box() const { return box_; }
  bool operator()(const Index<D>& cell) const { return marks_[offsetIn<D>(box_, cell)] != 0; }
  std::uint8_t* row(const Index<D>& first) { return &marks_[offsetIn<D>(box_, first)]; }
  const std::uint8_t* row(const Index<D>& first) const { return &marks_[offsetIn<D>(box_, first)]; }

  /// Marks all cells of a box.
  void fill(const Box& rows) {
    forEachRow<D>(rows, [&](const Index<D>& first, int count) { std::memset(row(first), 1, count); });
  }
  /// Removes the marks of cells in a box that are not marked in `other`.
  void keepOnly(const CellMarks& other, const Box& rows) {
    forEachRow<D>(rows, [&](const Index<D>& first, int count) {
      std::uint8_t* marks = row(first);
      const std::uint8_t* kept = other.row(first);
#pragma GCC ivdep
      for (int i = 0; i < count; ++i) marks[i] = static_cast<std::uint8_t>(marks[i] & kept[i]);
    });
  }
  /// Marks all cells of a box within `layers` layers of a marked cell of the box.
  void spread(int layers, const Box& rows) {
    forEachRow<D>(rows, [&](const Index<D>& first, int count) { spreadRow(row(first), count, layers); });
    if constexpr (D > 1) spreadAlong(1, box_.extent(0), layers, rows);
    if constexpr (D > 2) spreadAlong(2, static_cast<std::ptrdiff_t>(box_.extent(0)) * box_.extent(1), layers, rows);
  }

  /// Calls `visit(cell)` for the marked cells of a box.
  template <class Visit>
  void forEachIn(const Box& box, Visit&& visit) const {
    forEachRow<D>(box, [&](Index<D> cell, int count) {
      const std::uint8_t* marks = row(cell);
      const std::uint8_t* end = marks + count;
      const int start = cell[0];
      for (const std::uint8_t* at = marks; at < end; ++at) {
        if (!*at) at = static_cast<const std::uint8_t*>(std::memchr(at, 1, end - at));
        if (!at) return;
        cell[0] = start + static_cast<int>(at - marks);
        visit(cell);
      }
    });
  }
  /// Calls `visit(first, count)` for each run of cells of a box, along the first axis, that are not marked.
  template <class Visit>
  void forEachGapIn(const Box& box, Visit&& visit) const {
    forEachRow<D>(box, [&](Index<D> first, int count) {
      const std::uint8_t* marks = row(first);
      const int start = first[0];
      for (int i = 0; i < count;) {
        const void* next = std::memchr(marks + i, 1, count - i);
        const int end = next ? static_cast<int>(static_cast<const std::uint8_t*>(next) - marks) : count;
        first[0] = start + i;
        if (end > i) visit(first, end - i);
        for (i = end; i < count && marks[i];) ++i;
      }
    });
  }
  /// The part of a box, along the first axis, that contains all its marks; empty if there are none.
  Box withMarks(const Box& box) const {
    Box part = box;
    part.lower[0] = box.upper[0];
    part.upper[0] = box.lower[0];
    forEachRow<D>(box, [&](const Index<D>& first, int count) {
      const std::uint8_t* marks = row(first);
      const void* lowest = std::memchr(marks, 1, count);
      if (!lowest) return;
      int last = count - 1;
      while (!marks[last]) --last;
      const auto skipped = static_cast<int>(static_cast<const std::uint8_t*>(lowest) - marks);
      part.lower[0] = std::min(part.lower[0], first[0] + skipped);
      part.upper[0] = std::max(part.upper[0], first[0] + last + 1);
    });
    return part.lower[0] < part.upper[0] ? part : Box{};
  }
  bool anyIn(const Box& box) const {
    bool any = false;
    forEachRow<D>(box,
                  [&](const Index<D>& first, int count) { any = any || std::memchr(row(first), 1, count) != nullptr; });
    return any;
  }

 private:
  static void orRow(const std::uint8_t* from, int count, std::uint8_t* to) {
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) to[i] = static_cast<std::uint8_t>(to[i] | from[i]);
  }
  void spreadRow(std::uint8_t* marks, int count, int layers) {
    if (!std::memchr(marks, 1, count)) return;
    spare_.assign(marks, marks + count);
    for (int k = 1; k <= std::min(layers, count - 1); ++k) {
      orRow(spare_.data(), count - k, marks + k);
      orRow(spare_.data() + k, count - k, marks);
    }
  }
  /// Spreads marks along an axis other than the first. Neighbours along it are `stride` cells apart in memory.
  void spreadAlong(int axis, std::ptrdiff_t stride, int layers, const Box& rows) {
    spare_.resize(marks_.size());
    forEachRow<D>(rows, [&](const Index<D>& first, int count) {
      std::memcpy(&spare_[offsetIn<D>(box_, first)], row(first), count);
    });
    forEachRow<D>(rows, [&](const Index<D>& first, int count) {
      const std::uint8_t* from = &spare_[offsetIn<D>(box_, first)];
      if (!std::memchr(from, 1, count)) return;
      std::uint8_t* to = row(first);
      for (int k = -layers; k <= layers; ++k)
        if (k != 0 && first[axis] + k >= rows.lower[axis] && first[axis] + k < rows.upper[axis])
          orRow(from, count, to + k * stride);
    });
  }

  Box box_;
  std::vector<std::uint8_t> marks_;
  std::vector<std::uint8_t, euler::Unfilled<std::uint8_t>> spare_;  ///< copies of marks while these spread
};

/// The free volumes and the masses of gas in cells, row by row. Both views may end at the sides of the grid; a cell
/// whose mass is unknown counts as one with gas.
struct RoomAndMass {
  CellView<const double> free, mass;

  /// Returns the rows of `box` within `layers` layers of rows with cells for which isBody or, if `isAnyBody` is false,
  /// isEmpty is true; along the first axis, all of the box. It is empty if there are none.
  template <int D>
  Box rowsWithBodies(const Box& box, int layers, bool isAnyBody) const {
    Box rows = box;
    bool any = false;
    forEachRow<D>(box.intersect(free.box()), [&](const Index<D>& first, int count) {
      if (!hasBody(first, count, isAnyBody)) return;
      for (int d = 1; d < D; ++d) {
        rows.lower[d] = any ? std::min(rows.lower[d], first[d] - layers) : first[d] - layers;
        rows.upper[d] = any ? std::max(rows.upper[d], first[d] + layers + 1) : first[d] + layers + 1;
      }
      any = true;
    });
    return any ? rows.intersect(box) : Box{};
  }
  /// Marks the cells with a free volume below `whole`, or without gas.
  template <int D>
  void markBodies(CellMarks<D>& marks, const Box& rows, double whole) const {
    forEachRow<D>(rows.intersect(free.box()), [&](const Index<D>& first, int count) {
      std::uint8_t* row = marks.row(first);
      const double* room = &free[first];
#pragma GCC ivdep
      for (int i = 0; i < count; ++i) row[i] = static_cast<std::uint8_t>(room[i] < whole);
    });
    forEachRow<D>(rows.intersect(free.box()).intersect(mass.box()), [&](const Index<D>& first, int count) {
      std::uint8_t* row = marks.row(first);
      const double* held = &mass[first];
#pragma GCC ivdep
      for (int i = 0; i < count; ++i) row[i] = static_cast<std::uint8_t>(row[i] | !(held[i] > 0));
    });
  }
  /// Marks the cells within `layers` layers of a cell with gas.
  template <int D>
  void markAroundGas(CellMarks<D>& marks, int layers, const Box& rows) const {
    marks.fill(rows);
    forEachRow<D>(rows.intersect(free.box()).intersect(mass.box()), [&](const Index<D>& first, int count) {
      std::uint8_t* row = marks.row(first);
      const double *room = &free[first], *held = &mass[first];
#pragma GCC ivdep
      for (int i = 0; i < count; ++i) row[i] = static_cast<std::uint8_t>(!(room[i] < leastFreeVolume) & (held[i] > 0));
    });
    marks.spread(layers, rows);
  }

 private:
  template <int D>
  bool hasBody(Index<D> first, int count, bool isAnyBody) const {
    const double* room = &free[first];
    const double least = isAnyBody ? 1 : leastFreeVolume;
    std::int64_t any = 0;
    for (int i = 0; i < count; ++i) any |= room[i] < least ? 1 : 0;
    if (any) return true;
    const int from = std::max(first[0], mass.box().lower[0]), end = std::min(first[0] + count, mass.box().upper[0]);
    first[0] = from;
    if (from >= end || !mass.box().contains(first)) return false;
    const double* held = &mass[first];
    for (int i = 0; i < end - from; ++i) any |= held[i] > 0 ? 0 : 1;
    return any != 0;
  }
};

/// Marks the cells near bodies; all other cells contain only gas.
template <int D>
class NearBodies {
 public:
  /// Marks the cells of a box that are within `layers` layers of a cell with a free volume below `whole`, or without
  /// gas. Both views may end at the sides of the grid. `whole` is 1 if the results for other cells are to have the same
  /// bits; it is wholeFreeVolume if results near bodies differ by more than round-off.
  NearBodies(const Box& box, int layers, const CellView<const double>& free, const CellView<const double>& mass,
             double whole = 1)
      : near_(box.grown(layers, D)), acting_(near_.box()) {
    const RoomAndMass cells{free, mass};
    rows_ = cells.rowsWithBodies<D>(near_.box(), layers, true);
    if (rows_.empty()) return;
    cells.markBodies(near_, rows_, whole);
    const Box bodies = near_.withMarks(rows_);
    rows_.lower[0] = std::max(rows_.lower[0], bodies.lower[0] - layers);
    rows_.upper[0] = std::min(rows_.upper[0], bodies.upper[0] + layers);
    near_.spread(layers, rows_);
    cells.markAroundGas(acting_, layers, rows_);
    acting_.keepOnly(near_, rows_);
  }

  bool hasAny() const { return !rows_.empty(); }
  /// The part of the box, and of what is around it, in which there may be cells near bodies.
  const Box& rows() const { return rows_; }
  bool operator()(const Index<D>& cell) const { return near_(cell); }
  /// The marks of cells in a row.
  const std::uint8_t* row(const Index<D>& first) const { return near_.row(first); }
  /// Whether forEachActingIn visits a cell.
  bool acts(const Index<D>& cell) const { return acting_(cell); }
  /// Calls `visit(cell)` for the cells of a box that are near a body.
  template <class Visit>
  void forEachIn(const Box& box, Visit&& visit) const {
    near_.forEachIn(box.intersect(rows_), std::forward<Visit>(visit));
  }
  /// Like forEachIn, but leaves out cells in bodies if no cell within `layers` layers contains gas; it may visit some
  /// of them.
  template <class Visit>
  void forEachActingIn(const Box& box, Visit&& visit) const {
    acting_.forEachIn(box.intersect(rows_), std::forward<Visit>(visit));
  }
  /// Calls `visit(first, count)` for each run of cells of a box, along the first axis, that are not near a body.
  template <class Visit>
  void forEachFarRunIn(const Box& box, Visit&& visit) const {
    near_.forEachGapIn(box, std::forward<Visit>(visit));
  }
  bool anyIn(const Box& box) const { return near_.anyIn(box.intersect(rows_)); }

 private:
  CellMarks<D> near_, acting_;
  Box rows_;
};

}  // namespace tushar::mpmice
