#pragma once

#include <span>
#include <vector>

#include "core/solvers/solver.hpp"

namespace tushar::solvers {

/// A sparse matrix of square blocks in compressed rows, on one rank. The blocks of a row are in the order in which they
/// were added first.
class BlockMatrix : public Matrix {
 public:
  /// An empty matrix with space for the entries that the unknowns declare.
  explicit BlockMatrix(const Unknowns& unknowns);

  void add(std::span<const int> rows, std::span<const int> columns, std::span<const double> values) override;
  /// Sets all entries to 0, and calls `fill` to add entries. Blocks that have been added before stay in the pattern.
  template <class Fill>
  void assemble(Fill&& fill) {
    std::fill(values_.begin(), values_.end(), 0.0);
    fill(*this);
  }
  int block() const { return block_; }
  /// Number of block rows.
  int rows() const { return static_cast<int>(counts_.size()); }
  /// Number of blocks.
  std::size_t blocks() const { return blocks_; }
  /// The block columns of a block row.
  std::span<const int> columns(int row) const {
    return {columns_.data() + starts_[row], static_cast<std::size_t>(counts_[row])};
  }
  /// The values of the k-th block of a block row, row by row.
  const double* values(int row, int k) const { return values_.data() + (starts_[row] + k) * block_ * block_; }

 private:
  template <int B>
  void addBlocks(std::span<const int> rows, std::span<const int> columns, const double* values);
  int find(int row, int column, int from);

  int block_;
  std::size_t blocks_ = 0;
  std::vector<std::size_t> starts_;  ///< where the blocks of each row start
  std::vector<int> counts_, columns_;
  std::vector<double> values_;
};

}  // namespace tushar::solvers
