#pragma once

#include <Eigen/LU>

#include <span>
#include <vector>

#include "core/solvers/block_matrix.hpp"

namespace tushar::solvers {

/// LU factors of a sparse matrix by the multifrontal method: Duff & Reid, ACM Trans. Math. Software 9 (1983) 302. Rows
/// are exchanged only within the dense block that is eliminated together; the pattern is treated as symmetric. All sums
/// have an order that depends only on the pattern.
class BlockFactors {
 public:
  /// Chooses the order of elimination for the pattern of `matrix`: minimum degree (Amestoy, Davis & Duff, SIAM J.
  /// Matrix Anal. Appl. 17 (1996) 886).
  explicit BlockFactors(const BlockMatrix& matrix);

  /// Whether a matrix has the pattern for which the order was chosen.
  bool suits(const BlockMatrix& matrix) const;
  /// Factorizes a matrix with the same pattern. Returns false if it is singular.
  bool factorize(const BlockMatrix& matrix);
  /// Replaces b by the solution x of A x = b.
  void solve(std::span<double> b) const;

 private:
  /// Unknowns that are eliminated together, and those on which they act.
  struct Front {
    std::vector<int> blocks;      ///< places in the order of elimination: of its own blocks, then of those below
    int eliminated = 0;           ///< number of blocks that are eliminated
    std::vector<int> children;    ///< fronts whose remaining matrices it receives
    std::vector<int> inParent;    ///< for each of the other blocks, its place in the parent
    std::size_t firstEntry = 0;   ///< its first entry in entries_
    Eigen::MatrixXd left, above;  ///< L and U in the eliminated columns, and the remaining columns of U

    /// The place of a block row, given by its place in the order of elimination.
    int placeOf(int row) const;
    Eigen::PermutationMatrix<Eigen::Dynamic> exchange;  ///< of the rows of the eliminated block
    Eigen::MatrixXd rest;                               ///< the remaining matrix, until the parent has received it
  };
  /// A block of the matrix: block row, index in that row, and its place in a front.
  struct Entry {
    int row, k, i, j;
  };

  using Structure = std::vector<std::vector<int>>;

  void setOrder(std::vector<int> original);
  Structure structureOf(const BlockMatrix& matrix) const;
  void makeFronts(const Structure& structure);
  void connectFronts();
  void placeEntries(const BlockMatrix& matrix);
  void gather(std::size_t front, const BlockMatrix& matrix);
  bool eliminate(Front& front);

  int block_;
  std::vector<std::vector<int>> pattern_;  ///< the block columns of each block row
  std::vector<int> original_, place_;      ///< block row by place in the order of elimination, and the inverse
  std::vector<Front> fronts_;              ///< children before their parents
  std::vector<int> front_of_;              ///< the front that eliminates a block, by its place in the order
  std::vector<Entry> entries_;             ///< blocks of the matrix, front by front
  Eigen::MatrixXd whole_;                  ///< the matrix of the current front
};

}  // namespace tushar::solvers
