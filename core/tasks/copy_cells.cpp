#include "core/tasks/copy_cells.hpp"

#include <cstddef>
#include <cstring>

namespace tushar::tasks {

namespace {

/// Rows of bytes in memory: their first byte, and the distances between the starts of rows, and of planes of rows.
template <class Byte>
struct Rows {
  Byte* first;
  std::ptrdiff_t toRow, toPlane;
};

template <class Byte>
Rows<Byte> rowsOf(Byte* values, const grid::Box& stored, const Index3& first, std::size_t bytes) {
  const auto row = static_cast<std::ptrdiff_t>(stored.extent(0) * bytes);
  return {values + stored.offset(first) * bytes, row, row * stored.extent(1)};
}

/// Copies rows of `Length` bytes or, if that is 0, of `length` bytes.
template <std::size_t Length>
void copyRows(const grid::Box& box, const Rows<const std::byte>& from, const Rows<std::byte>& to, std::size_t length) {
  for (std::ptrdiff_t z = 0; z < box.extent(2); ++z) {
    const std::byte* source = from.first + z * from.toPlane;
    std::byte* target = to.first + z * to.toPlane;
    for (int y = 0; y < box.extent(1); ++y, source += from.toRow, target += to.toRow)
      std::memcpy(target, source, Length > 0 ? Length : length);
  }
}

}  // namespace

void copyCells(const grid::Box& box, const Index3& shift, std::size_t bytes, const KnownValues& from,
               const CellValues& to) {
  if (box.empty()) return;
  const auto source = rowsOf(from.values, from.stored, box.lower - shift, bytes);
  const auto target = rowsOf(to.values, to.stored, box.lower, bytes);
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
