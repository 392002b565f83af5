#include "core/solvers/numbering.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "core/data/views.hpp"
#include "tests/support/levels.hpp"

namespace tushar::solvers {

namespace {

/// A grid of 6 x 4 cells in 8 patches, periodic along x, as one of several ranks sees it.
std::unique_ptr<grid::Grid> sharedGrid(int rank, int ranks) {
  grid::Domain domain = test::domain({{6, 4, 1}}, {{4, 2, 1}});
  domain.periodic[0] = 1;
  return std::make_unique<grid::Grid>(domain, grid::Share{rank, ranks});
}

/// A square of 8 x 8 cells in blocks of 4, periodic along x, with the lower left block refined.
std::unique_ptr<grid::Grid> refinedGrid(int rank, int ranks, int blocksPerPatch) {
  grid::Domain domain = test::domain({{8, 8, 1}});
  domain.periodic[0] = 1;
  domain.refinement = {2, {{4, 4, 1}}, Index3::filled(blocksPerPatch), {{1, {0, 0, 0}, {0.4, 0.2, 0}}}};
  return std::make_unique<grid::Grid>(domain, grid::Share{rank, ranks});
}

}  // namespace

TEST(CellNumbering, IsLexicographicOnOneRank) {
  const auto grid = sharedGrid(0, 1);
  const CellNumbering number(*grid);

  EXPECT_EQ(number.owned(), 24);
  EXPECT_EQ(number(0, Index<2>{{5, 1}}), 11);
  EXPECT_EQ(number(0, Index<2>{{-1, 1}}), 11);  // the image beyond the periodic face
  EXPECT_EQ(number(0, Index<2>{{0, 4}}), -1);
}

TEST(CellNumbering, GivesGhostsTheNumbersOfTheirOwners) {
  constexpr int ranks = 3;
  std::map<int, Index<2>> cellOf;  // by the number among the cells of all ranks
  int first = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    const auto grid = sharedGrid(rank, ranks);
    const CellNumbering number(*grid);
    for (const grid::Patch& patch : grid->patches())
      grid::forEach<2>(patch.cells(), [&](const Index<2>& cell) { cellOf[first + number(0, cell)] = cell; });
    first += number.owned();
  }
  ASSERT_EQ(cellOf.size(), 24U);

  for (int rank = 0; rank < ranks; ++rank) {
    const auto grid = sharedGrid(rank, ranks);
    const CellNumbering number(*grid);
    EXPECT_FALSE(number.ghosts().empty());
    for (const auto& [among, cell] : cellOf) {
      const int ghost = number(0, cell) - number.owned();
      if (ghost < 0) continue;
      EXPECT_EQ(number.ghosts()[ghost], among);
    }
    for (const grid::Patch& patch : grid->patches())
      grid::forEach<2>(patch.cells(), [&](const Index<2>& cell) {
        EXPECT_GE(number(0, cell + Index<2>::unit(0)), 0);
        EXPECT_GE(number(0, cell - Index<2>::unit(0)), 0);
      });
  }
}

TEST(CellNumbering, GoesBlockByBlockThroughLevelsOnOneRankWhateverThePatches) {
  for (const int blocks : {1, 2}) {
    const auto grid = refinedGrid(0, 1, blocks);
    const CellNumbering number(*grid);

    EXPECT_EQ(number.owned(), 3 * 16 + 4 * 16);
    EXPECT_EQ(number(1, Index<2>{{0, 0}}), 0);
    EXPECT_EQ(number(1, Index<2>{{5, 0}}), 16 + 1);
    EXPECT_EQ(number(0, Index<2>{{4, 1}}), 4 * 16 + 4);
    EXPECT_EQ(number(0, Index<2>{{-4, 1}}), 4 * 16 + 4);  // the image beyond the periodic face
    EXPECT_EQ(number(1, Index<2>{{0, -1}}), -1);
    EXPECT_THROW(number(0, (Index<2>{{0, 0}})), data::AccessError);  // refined
  }
}

TEST(CellNumbering, GivesACellOfAnyLevelOneNumberOnAllRanksThatMeetIt) {
  constexpr int ranks = 3;
  std::map<std::pair<int, int>, int> ownNumbers;  // by level and place: among the cells of all ranks
  const auto placeOf = [](const Index<2>& cell) { return 100 * cell[1] + cell[0]; };
  int first = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    const auto grid = refinedGrid(rank, ranks, 1);
    const CellNumbering number(*grid);
    for (const grid::Patch& patch : grid->patches())
      grid::forEach<2>(patch.cells(), [&](const Index<2>& cell) {
        ownNumbers[{patch.level().number(), placeOf(cell)}] = first + number(patch.level().number(), cell);
      });
    first += number.owned();
  }
  ASSERT_EQ(ownNumbers.size(), 7U * 16);
  EXPECT_EQ(first, 7 * 16);

  for (int rank = 0; rank < ranks; ++rank) {
    const auto grid = refinedGrid(rank, ranks, 1);
    CellNumbering number(*grid);
    for (const auto& [place, among] : ownNumbers)
      number.meet(place.first, Index<2>{{place.second % 100, place.second / 100}});
    ASSERT_EQ(number.ghosts().size(), std::size_t(7 * 16 - number.owned()));
    for (const auto& [place, among] : ownNumbers) {
      const int ghost = number(place.first, Index<2>{{place.second % 100, place.second / 100}}) - number.owned();
      if (ghost < 0) continue;
      EXPECT_EQ(number.ghosts()[std::size_t(ghost)], among);
    }
  }
}

}  // namespace tushar::solvers
