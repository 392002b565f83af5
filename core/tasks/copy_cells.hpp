#pragma once

#include "core/tasks/transfer.hpp"

namespace tushar::tasks {

/// Copies the values of a box of cells or nodes, of `bytes` bytes each, to `to`: those of index c are at c - `shift` in
/// `from`.
void copyCells(const grid::Box& box, const Index3& shift, std::size_t bytes, const CellValues& from,
               const CellValues& to);

}  // namespace tushar::tasks
