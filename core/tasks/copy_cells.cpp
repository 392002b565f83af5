#include "core/tasks/copy_cells.hpp"

#include <cstddef>
#include <cstring>

namespace tushar::tasks {

namespace {

/// Rows of bytes in memory: their first byte, and the distances between the starts of rows, and of planes of rows.
struct Rows {
  std::byte* first;
  std::ptrdiff_t toRow, toPlane;
};

Rows rowsOf(const CellValues& values, const Index3& first, std::size_t bytes) {
  const auto row = static_cast<std::ptrdiff_t>(values.stored.extent(0) * bytes);
  return {values.values + values.stored.offset(first) * bytes, row, row * values.stored.extent(1)};
}

/// Copies rows of `Length` bytes; 0: of `length` bytes.
template <std::size_t Length>
void copyRows(const grid::Box& box, const Rows& from, const Rows& to, std::size_t length) {
  for (std::ptrdiff_t z = 0; z < box.extent(2); ++z) {
    const std::byte* source = from.first + z * from.toPlane;
    std::byte* target = to.first + z * to.toPlane;
    for (int y = 0; y < box.extent(1); ++y, source += from.toRow, target += to.toRow)
      std::memcpy(target, source, Length > 0 ? Length : length);
  }
}

}  // namespace

void copyCells(const grid::Box& box, const Index3& shift, std::size_t bytes, const CellValues& from,
               const CellValues& to) {
  if (box.empty()) return;
  const Rows source = rowsOf(from, box.lower - shift, bytes), target = rowsOf(to, box.lower, bytes);
  const std::size_t length = static_cast<std::size_t>(box.extent(0)) * bytes;
  switch (length) {  // beside a patch rows are short: a call for each would take longer than the copy
    case 8:
      return copyRows<8>(box, source, target, length);
    case 16:
      return copyRows<16>(box, source, target, length);
    case 24:
      return copyRows<24>(box, source, target, length);
    case 32:
      return copyRows<32>(box, source, target, length);
    case 48:
      return copyRows<48>(box, source, target, length);
    default:
      return copyRows<0>(box, source, target, length);
  }
}

}  // namespace tushar::tasks
