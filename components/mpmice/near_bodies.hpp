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
std::size_t offsetIn(const Box& box, const Index<D>& cell) {
  Index3 wide{};
  for (int d = 0; d < D; ++d) wide[d] = cell[d];
  return box.offset(wide);
}

/// Marks the cells near bodies; all other cells contain only gas.
template <int D>
class NearBodies {
 public:
  /// Marks the cells of a box that are within `layers` layers of a cell with a free volume below 1, or without gas.
  /// Both views may end at the sides of the grid.
  NearBodies(const Box& box, int layers, CellView<const double> free, CellView<const double> mass)
      : box_(box), is_near_(box.size(), 0) {
    forEach<D>(free.box().intersect(box.grown(layers, D)), [&](const Index<D>& cell) {
      if (!(free[cell] < 1) && (!mass.box().contains(cell) || mass[cell] > 0)) return;
      has_any_ = true;
      forEach<D>(cellsAround<D>(cell, layers).intersect(box_), [&](const Index<D>& at) { is_near_[offset(at)] = 1; });
    });
  }

  bool hasAny() const { return has_any_; }
  bool operator()(const Index<D>& cell) const { return is_near_[offset(cell)] != 0; }
  /// Calls `visit(cell)` for the cells of a box that are near a body.
  template <class Visit>
  void forEachIn(const Box& box, Visit&& visit) const {
    if (!has_any_) return;
    grid::forEachRow<D>(box, [&](Index<D> cell, int count) {
      const std::uint8_t* row = &is_near_[offset(cell)];
      const std::uint8_t* end = row + count;
      const int start = cell[0];
      for (const std::uint8_t* at = row; at < end; ++at) {
        at = static_cast<const std::uint8_t*>(std::memchr(at, 1, end - at));
        if (!at) return;
        cell[0] = start + static_cast<int>(at - row);
        visit(cell);
      }
    });
  }
  bool anyIn(const Box& box) const {
    bool any = false;
    if (has_any_)
      grid::forEachRow<D>(box, [&](const Index<D>& first, int count) {
        any = any || std::memchr(&is_near_[offset(first)], 1, count) != nullptr;
      });
    return any;
  }

 private:
  std::size_t offset(const Index<D>& cell) const { return offsetIn<D>(box_, cell); }

  Box box_;
  std::vector<std::uint8_t> is_near_;
  bool has_any_ = false;
};

}  // namespace tushar::mpmice
