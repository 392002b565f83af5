#include "core/solvers/block_matrix.hpp"

#include <stdexcept>

namespace tushar::solvers {

BlockMatrix::BlockMatrix(const Unknowns& unknowns) : block_(unknowns.block), counts_(unknowns.owned, 0) {
  starts_.assign(1, 0);
  for (const int entries : unknowns.entries) starts_.push_back(starts_.back() + entries);
  columns_.resize(starts_.back());
  values_.resize(starts_.back() * block_ * block_);
}

/// The index of a block in its row. The search starts at `from`, because blocks are usually added in the same order.
int BlockMatrix::find(int row, int column, int from) {
  const int count = counts_[row];
  int* const columns = columns_.data() + starts_[row];
  for (int k = from; k < count; ++k)
    if (columns[k] == column) return k;
  for (int k = 0; k < from; ++k)
    if (columns[k] == column) return k;
  if (starts_[row] + count == starts_[row + 1])
    throw std::logic_error("a row of a matrix has more entries than the unknowns declare");
  columns[count] = column;
  ++blocks_;
  return counts_[row]++;
}

template <int B>
void BlockMatrix::addBlocks(std::span<const int> rows, std::span<const int> columns, const double* values) {
  const std::size_t width = columns.size() * B;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int row = rows[r];
    if (row < 0) continue;
    const double* const from = values + r * B * width;
    int next = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (columns[c] < 0) continue;
      const int at = find(row, columns[c], next);
      next = at + 1;
      double* const into = values_.data() + (starts_[row] + at) * B * B;
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) into[B * i + j] += from[i * width + B * c + j];
    }
  }
}

void BlockMatrix::add(std::span<const int> rows, std::span<const int> columns, std::span<const double> values) {
  switch (block_) {
    case 1:
      return addBlocks<1>(rows, columns, values.data());
    case 2:
      return addBlocks<2>(rows, columns, values.data());
    case 3:
      return addBlocks<3>(rows, columns, values.data());
    default:
      throw std::logic_error("a matrix has blocks of one to three unknowns");
  }
}

}  // namespace tushar::solvers
