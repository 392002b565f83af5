#include "core/solvers/direct.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/solvers/block_factors.hpp"

namespace tushar::solvers {

namespace {

/// The equations of `width` x `height` nodes, each of which acts on its neighbours: unsymmetric blocks of random
/// numbers, with an offset of the diagonal that keeps the matrix regular.
class RandomGrid {
 public:
  RandomGrid(int width, int height, int block) : width_(width), height_(height) {
    unknowns_.block = block;
    unknowns_.owned = width * height;
    unknowns_.entries.assign(static_cast<std::size_t>(unknowns_.owned), 9);
  }
  const Unknowns& unknowns() const { return unknowns_; }
  int size() const { return unknowns_.owned * unknowns_.block; }

  /// Calls `visit(row, column, values)` for each block.
  template <class Visit>
  void forEachBlock(unsigned seed, Visit&& visit) const {
    std::mt19937 random(seed);
    const int block = unknowns_.block;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
            std::vector<double> values;
            for (int k = 0; k < block * block; ++k) {
              const bool isDiagonal = u == x && v == y && k % (block + 1) == 0;
              values.push_back(double(random() % 1000) / 1000 + (isDiagonal ? 20 : 0));
            }
            visit(y * width_ + x, v * width_ + u, values);
          }
  }
  void assemble(unsigned seed, Matrix& matrix) const {
    forEachBlock(seed, [&](int row, int column, const std::vector<double>& values) {
      matrix.add({&row, 1}, {&column, 1}, values);
    });
  }
  std::vector<double> times(unsigned seed, const std::vector<double>& x) const {
    std::vector<double> product(x.size(), 0);
    const auto block = static_cast<std::size_t>(unknowns_.block);
    forEachBlock(seed, [&](int row, int column, const std::vector<double>& values) {
      for (std::size_t i = 0; i < block; ++i)
        for (std::size_t j = 0; j < block; ++j)
          product[block * std::size_t(row) + i] += values[block * i + j] * x[block * std::size_t(column) + j];
    });
    return product;
  }

 private:
  int width_, height_;
  Unknowns unknowns_;
};

std::vector<double> waves(int count) {
  std::vector<double> x(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = std::sin(1 + double(k));
  return x;
}

}  // namespace

TEST(BlockFactors, SolveSystemsOfAnyBlocks) {
  for (const int block : {1, 2, 3}) {
    const RandomGrid grid(13, 8, block);
    BlockMatrix matrix(grid.unknowns());
    matrix.assemble([&](Matrix& into) { grid.assemble(1, into); });
    BlockFactors factors(matrix);
    for (const unsigned seed : {1U, 2U}) {  // other values, the same pattern
      matrix.assemble([&](Matrix& into) { grid.assemble(seed, into); });
      ASSERT_TRUE(factors.suits(matrix));
      ASSERT_GT(factors.factorize(matrix), 1e-3);
      const std::vector<double> expected = waves(grid.size());
      std::vector<double> x = grid.times(seed, expected);

      factors.solve(x);

      for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], expected[k], 1e-12) << block << ' ' << k;
    }
  }
}

TEST(BlockFactors, SuitOnlyTheirPattern) {
  const RandomGrid grid(5, 5, 2);
  BlockMatrix matrix(grid.unknowns()), other(grid.unknowns());
  matrix.assemble([&](Matrix& into) { grid.assemble(1, into); });
  const int first = 0;
  other.assemble([&](Matrix& into) { into.add({&first, 1}, {&first, 1}, std::vector<double>{1, 0, 0, 1}); });

  EXPECT_FALSE(BlockFactors(matrix).suits(other));
}

TEST(BlockMatrix, RefusesMoreEntriesThanDeclared) {
  Unknowns unknowns;
  unknowns.owned = 2;
  unknowns.entries = {1, 2};
  BlockMatrix matrix(unknowns);
  const std::vector<int> row{0}, columns{0, 1};

  EXPECT_THROW(matrix.add(row, columns, std::vector<double>{1, 1}), std::logic_error);
}

TEST(DirectSolve, EqualsThatOfPetsc) {
  const RandomGrid grid(9, 9, 2);
  const std::vector<double> b = waves(grid.size());
  std::vector<double> direct(b.size(), 0), byPetsc(b.size(), 0);
  const auto assemble = [&](Matrix& matrix) { grid.assemble(3, matrix); };
  const LinearSettings settings{"preonly", "lu", 1e-12, 10, ""};
  ASSERT_TRUE(isDirect(grid.unknowns(), settings));

  ASSERT_TRUE(solve(grid.unknowns(), {assemble, b}, settings, direct).converged);
  ASSERT_TRUE(solver().solve(grid.unknowns(), {assemble, b}, settings, byPetsc).converged);

  for (std::size_t k = 0; k < b.size(); ++k) EXPECT_NEAR(direct[k], byPetsc[k], 1e-14);
}

TEST(DirectSolve, TellsThatAMatrixIsSingular) {
  Unknowns unknowns;
  unknowns.owned = 2;
  unknowns.entries = {2, 2};
  const std::vector<int> both{0, 1};
  std::vector<double> b{1, 1}, x{0, 0};
  const auto assemble = [&](Matrix& matrix) { matrix.add(both, both, std::vector<double>{1, -1, -1, 1}); };

  const Outcome outcome = solve(unknowns, {assemble, b}, {"preonly", "lu", 1e-12, 10, ""}, x);

  EXPECT_FALSE(outcome.converged);
  EXPECT_EQ(outcome.reason, "the matrix is singular");
}

/// A system that only round-off keeps regular has a solution, which a Krylov method finds without large parts in
/// directions that the matrix does not feel.
TEST(DirectSolve, LeavesNearlySingularSystemsToPetsc) {
  Unknowns unknowns;
  unknowns.owned = 2;
  unknowns.entries = {2, 2};
  unknowns.axes = 2;
  const std::vector<int> both{0, 1};
  std::vector<double> b{1, -1}, x{0, 0};
  const auto assemble = [&](Matrix& matrix) { matrix.add(both, both, std::vector<double>{1, -1, -1, 1 + 1e-15}); };
  const LinearSettings automatic{"automatic", "gamg", 1e-10, 100, ""};
  ASSERT_TRUE(isDirect(unknowns, automatic));

  EXPECT_FALSE(solveDirectly(unknowns, {assemble, b}, automatic, x).has_value());
  EXPECT_TRUE(solveDirectly(unknowns, {assemble, b}, {"preonly", "lu", 1e-12, 10, ""}, x).has_value());
  const Outcome outcome = solve(unknowns, {assemble, b}, automatic, x);

  EXPECT_TRUE(outcome.converged) << outcome.reason;
  EXPECT_NEAR(x[0] - x[1], 1, 1e-9);
  EXPECT_LT(std::abs(x[0] + x[1]), 10);
}

TEST(DirectSolve, IsForSmallSystemsWithoutPetscsOptions) {
  Unknowns small;
  small.axes = 2;
  small.owned = 2000;
  Unknowns large = small, inSpace = small;
  large.owned = 1000000;
  inSpace.axes = 3;
  const LinearSettings automatic{"automatic", "gamg", 1e-8, 100, ""};
  LinearSettings hypre = automatic, monitored = automatic;
  hypre.preconditioner = "hypre";
  monitored.petsc = "-ksp_monitor";
  Unknowns closed = small;
  closed.constantIsFree = true;

  EXPECT_TRUE(isDirect(small, automatic));
  EXPECT_FALSE(isDirect(large, automatic));
  EXPECT_FALSE(isDirect(inSpace, automatic));
  EXPECT_FALSE(isDirect(small, hypre));
  EXPECT_FALSE(isDirect(small, monitored));
  EXPECT_FALSE(isDirect(closed, automatic));
  EXPECT_FALSE(isDirect(small, LinearSettings{}));
}

}  // namespace tushar::solvers
