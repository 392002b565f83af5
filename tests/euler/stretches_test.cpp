#include <gtest/gtest.h>

#include "components/euler/boundary.hpp"
#include "tests/euler/gas_box.hpp"

// Short rows that are computed together, and patches that are not at sides of the grid.

namespace tushar::euler {

namespace {

/// How often stretches visit each cell of `held`, in memory order, and the largest number of cells in a stretch.
template <int D>
std::pair<std::vector<int>, int> visitsOf(const Box& box, const Box& held) {
  std::vector<int> visits(held.size(), 0);
  int longest = 0;
  forEachStretch<D>(box, held, [&](const Index<D>& first, int count) {
    std::ptrdiff_t at = first[0] - held.lower[0];
    std::ptrdiff_t stride = held.extent(0);
    for (int d = 1; d < D; ++d, stride *= held.extent(d - 1)) at += (first[d] - held.lower[d]) * stride;
    for (int k = 0; k < count; ++k) ++visits.at(static_cast<std::size_t>(at + k));
    longest = std::max(longest, count);
  });
  return {visits, longest};
}

template <int D>
void expectOnceInEachCell(const Box& box, const Box& held) {
  const auto [visits, longest] = visitsOf<D>(box, held);
  EXPECT_LE(longest, kStretch + 7);
  std::size_t between = 0;
  forEach<3>(held, [&](const Index3& cell) {
    const int times = visits[held.offset(cell)];
    EXPECT_LE(times, 1);
    EXPECT_TRUE(times == 1 || !box.contains(cell));
    if (!box.contains(cell)) between += static_cast<std::size_t>(times);
  });
  const std::size_t planes = static_cast<std::size_t>(box.extent(2)), rows = static_cast<std::size_t>(box.extent(1));
  EXPECT_EQ(between, planes * (rows - 1) * static_cast<std::size_t>(held.extent(0) - box.extent(0)));
}

}  // namespace

TEST(Stretches, HoldEachCellOfABoxOnce) {
  for (const int width : {1, 5, 16, 61, 200})
    for (const int height : {1, 2, 9, 40}) {
      const Box plane{{{-3, 4, 0}}, {{-3 + width, 4 + height, 1}}};
      for (const int around : {0, 1, 2}) {
        expectOnceInEachCell<2>(plane, plane.grown(around, 2));
        Box cube = plane;
        cube.upper[2] = 3;
        expectOnceInEachCell<3>(cube, cube.grown(around, 3));
      }
    }
}

TEST(Stretches, OfNothingAreNone) {
  const auto refuse = [](const Index<2>&, int) { FAIL(); };
  forEachStretch<2>({{{2, 2, 0}}, {{2, 5, 1}}}, {{{0, 0, 0}}, {{9, 9, 1}}}, refuse);
}

TEST(Blocks, OfNarrowPatchesAreHighAndTileThemWithinTheCache) {
  for (const Index3& extents : {Index3{{512, 512, 1}}, Index3{{130, 40, 1}}, Index3{{64, 64, 1}}, Index3{{40, 56, 1}},
                                Index3{{8, 4000, 1}}, Index3{{1, 1, 1}}}) {
    const Box patch{{{3, 5, 0}}, {{3 + extents[0], 5 + extents[1], 1}}};
    const Box largest = largestBlock<2>(patch);
    EXPECT_LE(largest.grown(2, 2).size(), 132U * 20U);
    std::size_t cells = 0;
    forEachBlock<2>(patch, [&](const Box& block) {
      cells += block.size();
      EXPECT_EQ(block.intersect(patch), block);
      for (const int d : {0, 1}) EXPECT_LE(block.extent(d), largest.extent(d));
    });
    EXPECT_EQ(cells, patch.size());
  }
  EXPECT_EQ(blockOf<2>({{}, {{512, 512, 1}}}), kBlock<2>);
  EXPECT_EQ(blockOf<2>({{}, {{40, 56, 1}}}), (Index3{{40, 56, 1}}));
  EXPECT_EQ(blockOf<2>({{}, {{64, 64, 1}}}), (Index3{{64, 32, 1}}));
}

TEST(GasSides, HaveTheSameRulesNearAPatchAsForTheWholeGrid) {
  const Grid grid(closedBox(2, 8));
  const Level& level = grid.level();
  const GhostRules<2> all = ghostRules<2>(level, {});
  const std::vector<Box> patches{
      level.cells(), {{{0, 0, 0}}, {{4, 4, 1}}}, {{{4, 2, 0}}, {{8, 6, 1}}}, {{{2, 2, 0}}, {{6, 6, 1}}}};
  for (const Box& patch : patches) {
    const Box around = patch.grown(2, 2);
    Rows<2> expected(around.size()), found(around.size());
    for (Rows<2>* rows : {&expected, &found}) {
      rows->hold(around);
      forEach<2>(level.clipCells(around),
                 [&](const Index<2>& cell) { store<2>(rows->at(cell), 0, roughGas<2>(level.cellCentre<2>(cell))); });
    }
    fillBeyondGrid<2>(level, all, expected);
    fillBeyondGrid<2>(level, ghostRules<2>(level, {}, 0, around), found);
    forEach<2>(around, [&](const Index<2>& cell) { EXPECT_EQ(found.state(cell), expected.state(cell)); });
  }
}

}  // namespace tushar::euler
