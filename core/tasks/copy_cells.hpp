#pragma once

#include "core/tasks/transfer.hpp"

namespace tushar::tasks {

/// Values in memory that are only read.
struct KnownValues {
  KnownValues(const std::byte* at, const grid::Box& box) : values(at), stored(box) {}
  KnownValues(const CellValues& of) : KnownValues(of.values, of.stored) {}

  const std::byte* values;
  grid::Box stored;
};

/// Copies the values of a box of cells or nodes, of `bytes` bytes each, to `to`; the value for index c is at index c -
/// `shift` in `from`.
void copyCells(const grid::Box& box, const Index3& shift, std::size_t bytes, const KnownValues& from,
               const CellValues& to);

}  // namespace tushar::tasks
