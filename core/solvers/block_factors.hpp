#pragma once

#include <Eigen/SparseCore>

#include <memory>
#include <span>
#include <vector>

#include "core/solvers/block_matrix.hpp"

namespace tushar::solvers {

/// LU factors of a sparse matrix, by KLU (Davis & Palamadai Natarajan, ACM Trans. Math. Software 37 (2010) 36), which
/// suits systems in two dimensions. The order of elimination is that of minimum degree (Amestoy, Davis & Duff, SIAM J.
/// Matrix Anal. Appl. 17 (1996) 886); rows are exchanged where a diagonal entry is small. So the factors depend only on
/// the matrix, not on earlier ones.
class BlockFactors {
 public:
  /// Chooses the order of elimination for the pattern of `matrix`.
  explicit BlockFactors(const BlockMatrix& matrix);
  ~BlockFactors();
  BlockFactors(BlockFactors&& other) noexcept;
  BlockFactors& operator=(BlockFactors&& other) noexcept;

  /// Whether a matrix has the pattern for which the order was chosen.
  bool suits(const BlockMatrix& matrix) const;
  /// Factorizes a matrix with the same pattern. Returns the ratio of the smallest to the largest pivot, after rows have
  /// been scaled: an estimate of the reciprocal condition number, 0 if the matrix is singular.
  double factorize(const BlockMatrix& matrix);
  /// Replaces b by the solution x of A x = b.
  void solve(std::span<double> b) const;

 private:
  struct Factors;  // of KLU, whose headers only the source file includes

  int block_;
  std::vector<std::vector<int>> pattern_;  ///< the block columns of each block row
  Eigen::SparseMatrix<double> numbers_;    ///< the matrix, number by number
  std::vector<int> places_;                ///< the place in numbers_ of each number of the blocks, row by row
  std::unique_ptr<Factors> factors_;
};

}  // namespace tushar::solvers
