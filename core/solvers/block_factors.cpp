#include "core/solvers/block_factors.hpp"

#include <Eigen/KLUSupport>

#include <algorithm>

namespace tushar::solvers {

namespace {

/// Calls `visit(row, column, value)` for each number of a matrix of blocks.
template <class Visit>
void forEachNumber(const BlockMatrix& matrix, Visit&& visit) {
  const int block = matrix.block();
  for (int row = 0; row < matrix.rows(); ++row)
    for (int k = 0; const int column : matrix.columns(row)) {
      const double* values = matrix.values(row, k++);
      for (int i = 0; i < block; ++i)
        for (int j = 0; j < block; ++j) visit(block * row + i, block * column + j, *values++);
    }
}

}  // namespace

struct BlockFactors::Factors : Eigen::KLU<Eigen::SparseMatrix<double>> {
  double ratioOfPivots() {
    return info() == Eigen::Success && klu_rcond(m_symbolic, m_numeric, &m_common) ? m_common.rcond : 0;
  }
};

BlockFactors::~BlockFactors() = default;
BlockFactors::BlockFactors(BlockFactors&& other) noexcept = default;
BlockFactors& BlockFactors::operator=(BlockFactors&& other) noexcept = default;

BlockFactors::BlockFactors(const BlockMatrix& matrix)
    : block_(matrix.block()),
      numbers_(matrix.rows() * matrix.block(), matrix.rows() * matrix.block()),
      factors_(std::make_unique<Factors>()) {
  for (int row = 0; row < matrix.rows(); ++row)
    pattern_.emplace_back(matrix.columns(row).begin(), matrix.columns(row).end());
  std::vector<Eigen::Triplet<double>> ordinals;
  forEachNumber(matrix, [&](int row, int column, double) {
    ordinals.emplace_back(row, column, static_cast<double>(ordinals.size()));
  });
  numbers_.setFromTriplets(ordinals.begin(), ordinals.end());
  places_.resize(ordinals.size());
  for (int place = 0; place < static_cast<int>(places_.size()); ++place)
    places_[static_cast<std::size_t>(numbers_.valuePtr()[place])] = place;
  factors_->kluCommon().btf = 0;  // systems of neighbouring nodes or cells do not fall into parts
  factors_->analyzePattern(numbers_);
}

bool BlockFactors::suits(const BlockMatrix& matrix) const {
  if (matrix.block() != block_ || matrix.rows() != static_cast<int>(pattern_.size())) return false;
  for (int row = 0; row < matrix.rows(); ++row) {
    const std::span<const int> columns = matrix.columns(row);
    if (!std::equal(columns.begin(), columns.end(), pattern_[row].begin(), pattern_[row].end())) return false;
  }
  return true;
}

double BlockFactors::factorize(const BlockMatrix& matrix) {
  std::size_t k = 0;
  forEachNumber(matrix, [&](int, int, double value) { numbers_.valuePtr()[places_[k++]] = value; });
  factors_->factorize(numbers_);
  return factors_->ratioOfPivots();
}

void BlockFactors::solve(std::span<double> b) const {
  Eigen::Map<Eigen::VectorXd> right(b.data(), static_cast<Eigen::Index>(b.size()));
  right = factors_->solve(right.eval());
}

}  // namespace tushar::solvers
