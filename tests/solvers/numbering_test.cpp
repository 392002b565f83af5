#include "core/solvers/numbering.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "tests/support/levels.hpp"

namespace tushar::solvers {

namespace {

/// A grid of 6 x 4 cells in 8 patches, periodic along x, as one of some ranks sees it.
std::unique_ptr<grid::Grid> sharedGrid(int rank, int ranks) {
  grid::Domain domain = test::domain({{6, 4, 1}}, {{4, 2, 1}});
  domain.periodic[0] = 1;
  return std::make_unique<grid::Grid>(domain, grid::Share{rank, ranks});
}

}  // namespace

TEST(CellNumbering, IsLexicographicOnOneRank) {
  const auto grid = sharedGrid(0, 1);
  const CellNumbering number(grid->level());

  EXPECT_EQ(number.owned(), 24);
  EXPECT_EQ(number(Index<2>{{5, 1}}), 11);
  EXPECT_EQ(number(Index<2>{{-1, 1}}), 11);  // the image beyond the periodic face
  EXPECT_EQ(number(Index<2>{{0, 4}}), -1);
}

TEST(CellNumbering, GivesGhostsTheNumbersOfTheirOwners) {
  constexpr int ranks = 3;
  std::map<int, Index<2>> cellOf;  // by the number among the cells of all ranks
  int first = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    const auto grid = sharedGrid(rank, ranks);
    const CellNumbering number(grid->level());
    for (const grid::Patch& patch : grid->patches())
      grid::forEach<2>(patch.cells(), [&](const Index<2>& cell) { cellOf[first + number(cell)] = cell; });
    first += number.owned();
  }
  ASSERT_EQ(cellOf.size(), 24U);

  for (int rank = 0; rank < ranks; ++rank) {
    const auto grid = sharedGrid(rank, ranks);
    const CellNumbering number(grid->level());
    EXPECT_FALSE(number.ghosts().empty());
    for (const auto& [among, cell] : cellOf) {
      const int ghost = number(cell) - number.owned();
      if (ghost < 0) continue;
      EXPECT_EQ(number.ghosts()[ghost], among);
    }
    for (const grid::Patch& patch : grid->patches())
      grid::forEach<2>(patch.cells(), [&](const Index<2>& cell) {
        EXPECT_GE(number(cell + Index<2>::unit(0)), 0);
        EXPECT_GE(number(cell - Index<2>::unit(0)), 0);
      });
  }
}

}  // namespace tushar::solvers
