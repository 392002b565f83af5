#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <utility>

#include "components/mpmice/settings.hpp"

namespace tushar::mpmice {

/// Sets of cells, each of a cell and the cells around it: bit sum_d 3^d (offset_d + 1) stands for each of them.
template <int D>
struct Surroundings {
  using Set = std::uint32_t;
  static constexpr Set none = 0;

  static Set bitOf(const Index<D>& cell, const Index<D>& neighbour) {
    int bit = 0;
    for (int d = D - 1; d >= 0; --d) bit = 3 * bit + neighbour[d] - cell[d] + 1;
    return Set{1} << bit;
  }
  /// The first cell of a set around a cell that is not empty.
  static Index<D> firstOf(Set cells, Index<D> cell) {
    int bit = std::countr_zero(cells);
    for (int d = 0; d < D; ++d, bit /= 3) cell[d] += bit % 3 - 1;
    return cell;
  }
  template <class Visit>
  static void forEachOf(Set cells, const Index<D>& cell, Visit&& visit) {
    for (; cells != none; cells &= cells - 1) visit(firstOf(cells, cell));
  }
  /// The sum of `valueOf(at)` over a set of cells around a cell that is not empty. Along each axis, the values on
  /// opposite sides are added first, so that the sums of mirrored cells have the same bits.
  template <class ValueOf>
  static auto sum(Set cells, const Index<D>& cell, ValueOf&& valueOf, int axis = D - 1) -> decltype(valueOf(cell)) {
    if (std::popcount(cells) == 1) return valueOf(firstOf(cells, cell));
    std::optional<decltype(valueOf(cell))> total;
    for (const int offset : {-1, 1, 0}) {
      const Set here = cells & slice(axis, offset);
      if (here == none) continue;
      const auto value = Surroundings::sum(here, cell, valueOf, axis - 1);
      if (total)
        *total += value;
      else
        total = value;
    }
    return *total;
  }

 private:
  /// The bits of the cells at an offset of -1, 0 or 1 along an axis.
  static constexpr Set slice(int axis, int offset) {
    Set bits = none;
    int stride = 1, count = 1;
    for (int d = 0; d < axis; ++d) stride *= 3;
    for (int d = 0; d < D; ++d) count *= 3;
    for (int bit = 0; bit < count; ++bit)
      if (bit / stride % 3 - 1 == offset) bits |= Set{1} << bit;
    return bits;
  }
};

}  // namespace tushar::mpmice
