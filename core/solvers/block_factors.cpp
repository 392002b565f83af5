#include "core/solvers/block_factors.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tushar::solvers {

namespace {

using Structure = std::vector<std::vector<int>>;

std::vector<int> minimumDegreeOrder(const BlockMatrix& matrix) {
  std::vector<Eigen::Triplet<double>> blocks;
  for (int row = 0; row < matrix.rows(); ++row)
    for (const int column : matrix.columns(row)) blocks.emplace_back(row, column, 1.0);
  Eigen::SparseMatrix<double> pattern(matrix.rows(), matrix.rows());
  pattern.setFromTriplets(blocks.begin(), blocks.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  return {order.indices().begin(), order.indices().end()};
}

/// The first block after a column in its structure: its parent in the elimination tree; -1: none.
int parentOf(const Structure& structure, std::size_t column) {
  return structure[column].empty() ? -1 : structure[column].front();
}

/// The columns such that children come directly before their parents.
std::vector<int> postorder(const Structure& structure) {
  const int count = static_cast<int>(structure.size());
  Structure children(count);
  std::vector<int> stack, order;
  for (int k = count - 1; k >= 0; --k) {
    const int parent = parentOf(structure, k);
    (parent < 0 ? stack : children[parent]).push_back(k);
  }
  while (!stack.empty()) {
    const int k = stack.back();
    stack.pop_back();
    order.push_back(k);
    stack.insert(stack.end(), children[k].begin(), children[k].end());
  }
  std::reverse(order.begin(), order.end());
  return order;
}

/// Consecutive columns that are eliminated together.
struct Columns {
  int first, count, below;  ///< number of blocks below the columns
  double zeros;             ///< blocks that are stored although they are 0

  /// The columns before these and these, if there are few additional zeros.
  bool absorb(const Columns& before) {
    const double added = zeros + before.zeros + double(before.count) * (count + below - before.below);
    const int all = before.count + count;
    const double stored = double(all) * (all + 2.0 * below);
    if (added > std::max(0.1 * stored, all <= 4 ? 12.0 : 0.0)) return false;
    *this = {before.first, all, below, added};
    return true;
  }
};

}  // namespace

BlockFactors::BlockFactors(const BlockMatrix& matrix) : block_(matrix.block()) {
  setOrder(minimumDegreeOrder(matrix));
  std::vector<int> order = postorder(structureOf(matrix));
  for (int& k : order) k = original_[k];
  setOrder(std::move(order));
  makeFronts(structureOf(matrix));
  connectFronts();
  placeEntries(matrix);
  for (int row = 0; row < matrix.rows(); ++row)
    pattern_.emplace_back(matrix.columns(row).begin(), matrix.columns(row).end());
}

bool BlockFactors::suits(const BlockMatrix& matrix) const {
  if (matrix.block() != block_ || matrix.rows() != static_cast<int>(pattern_.size())) return false;
  for (int row = 0; row < matrix.rows(); ++row) {
    const std::span<const int> columns = matrix.columns(row);
    if (!std::equal(columns.begin(), columns.end(), pattern_[row].begin(), pattern_[row].end())) return false;
  }
  return true;
}

void BlockFactors::setOrder(std::vector<int> original) {
  original_ = std::move(original);
  place_.resize(original_.size());
  for (std::size_t k = 0; k < original_.size(); ++k) place_[original_[k]] = static_cast<int>(k);
}

/// For each column of L, the blocks below its diagonal.
auto BlockFactors::structureOf(const BlockMatrix& matrix) const -> Structure {
  Structure structure(place_.size()), children(place_.size());
  for (int row = 0; row < matrix.rows(); ++row)
    for (const int column : matrix.columns(row)) {
      const auto [first, last] = std::minmax(place_[row], place_[column]);
      if (first < last) structure[first].push_back(last);
    }
  std::vector<int> seenBy(place_.size(), -1);
  for (int k = 0; k < static_cast<int>(place_.size()); ++k) {
    std::vector<int> below;
    const auto see = [&](const std::vector<int>& blocks) {
      for (const int other : blocks)
        if (other != k && std::exchange(seenBy[other], k) != k) below.push_back(other);
    };
    see(structure[k]);
    for (const int child : children[k]) see(structure[child]);
    std::sort(below.begin(), below.end());
    structure[k] = std::move(below);
    if (const int parent = parentOf(structure, k); parent >= 0) children[parent].push_back(k);
  }
  return structure;
}

void BlockFactors::makeFronts(const Structure& structure) {
  std::vector<Columns> groups;
  for (int k = 0; k < static_cast<int>(structure.size()); ++k) {
    Columns group{k, 1, static_cast<int>(structure[k].size()), 0};
    while (!groups.empty() && parentOf(structure, group.first - 1) == group.first && group.absorb(groups.back()))
      groups.pop_back();
    groups.push_back(group);
  }
  front_of_.resize(structure.size());
  for (const Columns& group : groups) {
    Front& front = fronts_.emplace_back();
    front.eliminated = group.count;
    front.blocks.resize(group.count);
    std::iota(front.blocks.begin(), front.blocks.end(), group.first);
    const std::vector<int>& below = structure[group.first + group.count - 1];
    front.blocks.insert(front.blocks.end(), below.begin(), below.end());
    std::fill_n(front_of_.begin() + group.first, group.count, static_cast<int>(fronts_.size()) - 1);
  }
}

int BlockFactors::Front::placeOf(int row) const {
  if (row < blocks.front() + eliminated) return row - blocks.front();
  return static_cast<int>(std::lower_bound(blocks.begin() + eliminated, blocks.end(), row) - blocks.begin());
}

void BlockFactors::connectFronts() {
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    Front& front = fronts_[f];
    if (front.eliminated == static_cast<int>(front.blocks.size())) continue;
    Front& parent = fronts_[front_of_[front.blocks[front.eliminated]]];
    parent.children.push_back(static_cast<int>(f));
    for (std::size_t k = front.eliminated; k < front.blocks.size(); ++k)
      front.inParent.push_back(parent.placeOf(front.blocks[k]));
  }
}

void BlockFactors::placeEntries(const BlockMatrix& matrix) {
  const auto frontOf = [&](int row, int column) { return front_of_[std::min(place_[row], place_[column])]; };
  std::vector<std::size_t> next(fronts_.size() + 1, 0);
  for (int row = 0; row < matrix.rows(); ++row)
    for (const int column : matrix.columns(row)) ++next[frontOf(row, column) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::size_t f = 0; f < fronts_.size(); ++f) fronts_[f].firstEntry = next[f];
  entries_.resize(matrix.blocks());
  for (int row = 0; row < matrix.rows(); ++row)
    for (int k = 0; const int column : matrix.columns(row)) {
      const int f = frontOf(row, column);
      entries_[next[f]++] = {row, k++, fronts_[f].placeOf(place_[row]), fronts_[f].placeOf(place_[column])};
    }
}

/// Sets up the matrix of a front: the entries of the matrix, and what its children leave.
void BlockFactors::gather(std::size_t f, const BlockMatrix& matrix) {
  const Front& front = fronts_[f];
  const auto size = static_cast<Eigen::Index>(front.blocks.size()) * block_;
  whole_.setZero(size, size);
  const std::size_t end = f + 1 < fronts_.size() ? fronts_[f + 1].firstEntry : entries_.size();
  for (std::size_t e = front.firstEntry; e < end; ++e) {
    const Entry& entry = entries_[e];
    const double* values = matrix.values(entry.row, entry.k);
    for (int i = 0; i < block_; ++i)
      for (int j = 0; j < block_; ++j) whole_(block_ * entry.i + i, block_ * entry.j + j) = *values++;
  }
  for (const int c : front.children) {
    Front& child = fronts_[c];
    const std::size_t count = child.inParent.size();
    for (std::size_t m = 0; m < count * block_; ++m) {
      const double* from = &child.rest(0, static_cast<Eigen::Index>(m));
      double* into = &whole_(0, block_ * child.inParent[m / block_] + static_cast<int>(m) % block_);
      for (std::size_t n = 0; n < count; ++n)
        for (int i = 0; i < block_; ++i) into[block_ * child.inParent[n] + i] += *from++;
    }
    child.rest.resize(0, 0);
  }
}

/// Eliminates the first blocks of a front from its matrix; returns false if they are singular.
bool BlockFactors::eliminate(Front& front) {
  const Eigen::Index k = front.eliminated * block_, others = whole_.rows() - k;
  Eigen::Ref<Eigen::MatrixXd> corner(whole_.topLeftCorner(k, k));
  const Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>> factors(corner);
  for (Eigen::Index i = 0; i < k; ++i)
    if (corner(i, i) == 0 || !std::isfinite(corner(i, i))) return false;
  front.exchange = factors.permutationP();
  if (others > 0) {
    front.above = front.exchange * whole_.topRightCorner(k, others);
    corner.triangularView<Eigen::UnitLower>().solveInPlace(front.above);
    auto below = whole_.bottomLeftCorner(others, k);
    corner.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(below);
    front.rest = whole_.bottomRightCorner(others, others);
    front.rest.noalias() -= below * front.above;
  }
  front.left = whole_.leftCols(k);
  return true;
}

bool BlockFactors::factorize(const BlockMatrix& matrix) {
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    gather(f, matrix);
    if (!eliminate(fronts_[f])) return false;
  }
  return true;
}

void BlockFactors::solve(std::span<double> b) const {
  const auto rowOf = [&](const Front& front, Eigen::Index k) -> double& {
    return b[block_ * original_[front.blocks[k / block_]] + k % block_];
  };
  Eigen::VectorXd x, others;
  const auto take = [&](const Front& front) {
    const Eigen::Index k = front.left.cols();
    x.resize(k);
    others.resize(front.left.rows() - k);
    for (Eigen::Index i = 0; i < k; ++i) x[i] = rowOf(front, i);
    for (Eigen::Index i = 0; i < others.size(); ++i) others[i] = rowOf(front, k + i);
  };
  for (const Front& front : fronts_) {
    const Eigen::Index k = front.left.cols();
    take(front);
    x = front.exchange * x;
    front.left.topRows(k).triangularView<Eigen::UnitLower>().solveInPlace(x);
    others.noalias() -= front.left.bottomRows(others.size()) * x;
    for (Eigen::Index i = 0; i < k; ++i) rowOf(front, i) = x[i];
    for (Eigen::Index i = 0; i < others.size(); ++i) rowOf(front, k + i) = others[i];
  }
  for (auto at = fronts_.rbegin(); at != fronts_.rend(); ++at) {
    const Front& front = *at;
    const Eigen::Index k = front.left.cols();
    take(front);
    if (others.size() > 0) x.noalias() -= front.above * others;
    front.left.topRows(k).triangularView<Eigen::Upper>().solveInPlace(x);
    for (Eigen::Index i = 0; i < k; ++i) rowOf(front, i) = x[i];
  }
}

}  // namespace tushar::solvers
