#include "core/grid/grid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/support/levels.hpp"

namespace tushar::grid {

using test::domain;

TEST(Box, IsVisitedWithTheFirstAxisFastest) {
  const Box box{{{1, 5, 0}}, {{3, 7, 1}}};
  std::vector<Index<2>> visited;

  forEach<2>(box, [&](const Index<2>& at) { visited.push_back(at); });

  const std::vector<Index<2>> expected{{{1, 5}}, {{2, 5}}, {{1, 6}}, {{2, 6}}};
  EXPECT_EQ(visited, expected);
}

TEST(Box, GivesConsecutiveOffsetsInTheOrderOfVisits) {
  const Box box{{{-1, 2, 3}}, {{2, 4, 6}}};
  std::size_t next = 0;

  forEach<3>(box, [&](const Index3& at) { EXPECT_EQ(box.offset(at), next++); });

  EXPECT_EQ(next, box.size());
}

TEST(Box, FindsTheStartOfEachRowAndOfAnEmptyBoxNone) {
  const Box box{{{1, 5, 0}}, {{3, 7, 1}}}, empty{{{1, 5, 0}}, {{1, 7, 1}}};
  std::vector<Index3> starts;

  for (const Box& one : {box, empty}) forEach<3>(one.rowStarts(), [&](const Index3& at) { starts.push_back(at); });

  EXPECT_EQ(starts, (std::vector<Index3>{{{1, 5, 0}}, {{1, 6, 0}}}));
}

TEST(Level, WrapsCellsAlongPeriodicAxesAlone) {
  Domain plane = domain({{8, 4, 1}});
  plane.periodic[1] = 1;
  for (const int side : {0, 1}) plane.boundaries.face(1, side).clear();
  const Grid grid(plane);
  const Level& level = grid.level();

  EXPECT_EQ(level.wrapped(Index<2>{{3, 2}}), (Index<2>{{3, 2}}));
  EXPECT_EQ(level.wrapped(Index<2>{{-1, -1}}), (Index<2>{{-1, 3}}));
  EXPECT_EQ(level.wrapped(Index3{{9, 9, 0}}), (Index3{{9, 1, 0}}));
}

TEST(Level, LeavesOutAxesWithOneCellBetweenSymmetryPlanesOrWithoutExtent) {
  Domain flat = domain({{8, 4, 1}});
  flat.upper[1] = 0;
  flat.resolution[1] = 1;
  Domain open = domain({{8, 1, 1}});
  open.boundaries.face(1, 1).clear();

  EXPECT_EQ(Level(domain({{8, 1, 1}})).dimension(), 1);
  EXPECT_EQ(Level(domain({{8, 1, 3}})).axis(1), 2);
  EXPECT_EQ(Level(flat).dimension(), 1);
  EXPECT_EQ(Level(open).dimension(), 2);
}

TEST(Level, CountsTheCrossSectionInTheVolumeOfItsCells) {
  EXPECT_NEAR(Level(domain({{8, 1, 1}})).cellVolume(), 0.6 * 0.4 / 8, 1e-16);
}

TEST(Level, TilesTheGridWithPatches) {
  for (const Index3& patches : {Index3{{1, 1, 1}}, {{3, 2, 1}}, {{7, 5, 4}}, {{16, 6, 4}}}) {
    const Grid grid(domain({{16, 6, 4}}, patches));
    const Level& level = grid.level();
    std::vector<int> owners(level.cells().size(), 0);
    for (const Patch& patch : grid.patches())
      forEach<3>(patch.cells(), [&](const Index3& cell) {
        ++owners[level.cells().offset(cell)];
        EXPECT_EQ(grid.patchOf(cell, 0).id(), patch.id());
      });
    EXPECT_EQ(std::set<int>(owners.begin(), owners.end()), std::set<int>{1});
  }
}

TEST(Level, FindsThePatchesThatOverlapABox) {
  const Grid grid(domain({{16, 6, 1}}, {{4, 3, 1}}));

  std::set<int> found;
  for (const Patch& patch : grid.patchesOverlapping({{{3, 1, 0}}, {{5, 2, 1}}}, 0)) found.insert(patch.id());

  EXPECT_EQ(found, (std::set<int>{0, 1}));
}

TEST(Level, PutsAPointOnAFaceIntoTheCellAboveAndTheUpperEndIntoTheLast) {
  const Grid grid(domain({{10, 1, 1}}));
  const Level& level = grid.level();

  for (int cell = 0; cell < 10; ++cell) EXPECT_EQ(level.cellAlong(0, level.nodePosition(0, cell)), cell);
  EXPECT_EQ(level.cellAlong(0, 1.0), 9);
  EXPECT_EQ(level.cellAlong(0, std::nextafter(1.0, 2.0)), 10);
  EXPECT_EQ(level.cellAlong(0, -1e-300), -1);
  EXPECT_EQ(level.cellAlong(0, std::numeric_limits<double>::quiet_NaN()), -1);
}

TEST(Level, ExpandsPointsToTheMiddleOfAxesLeftOut) {
  const Grid grid(domain({{10, 1, 1}}));
  const Level& level = grid.level();

  EXPECT_EQ(level.expandPoint<1>(Vec<1>(0.25)), Vec3(0.25, 0.3, 0.2));
  EXPECT_EQ(level.expandDirection<1>(Vec<1>(2.0)), Vec3(2, 0, 0));
}

TEST(Patch, HasTheNodesOfItsCellsAndThoseWithinReachOnTheGrid) {
  const Grid grid(domain({{9, 1, 1}}, {{3, 1, 1}}));
  const Level& level = grid.level();
  const Patch& middle = grid.patches()[1];

  EXPECT_EQ(middle.nodes(), (Box{{{3, 0, 0}}, {{7, 1, 1}}}));
  EXPECT_EQ(middle.nodesWithin(2), (Box{{{1, 0, 0}}, {{9, 1, 1}}}));
  EXPECT_EQ(middle.cellsWithin(9), level.cells());
  EXPECT_FALSE(middle.isAtBoundary(0, 0));
  EXPECT_TRUE(grid.patches()[2].isAtBoundary(0, 1));
}

TEST(Level, GoesOnBeyondItsEndsAlongPeriodicAxes) {
  Domain ring = domain({{8, 4, 1}}, {{2, 1, 1}});
  ring.boundaries.faces[0].clear();
  ring.boundaries.faces[1].clear();
  ring.periodic[0] = 1;
  const Grid grid(ring);
  const Level& level = grid.level();
  const Patch& first = grid.patches().front();

  EXPECT_EQ(first.cellsWithin(2), (Box{{{-2, 0, 0}}, {{6, 4, 1}}}));
  EXPECT_EQ(first.nodesWithin(1), (Box{{{-1, 0, 0}}, {{6, 5, 1}}}));
  EXPECT_FALSE(first.isAtBoundary(0, 0));
  EXPECT_TRUE(first.isAtBoundary(1, 0));
  EXPECT_EQ(level.clipCells({{{-3, -3, 0}}, {{9, 9, 1}}}), (Box{{{-3, 0, 0}}, {{9, 4, 1}}}));
  EXPECT_EQ(level.imagesOverlapping({{{-1, 0, 0}}, {{3, 1, 1}}}), (std::vector<Index3>{{{-8, 0, 0}}, {{0, 0, 0}}}));
  EXPECT_EQ(level.imagesOverlapping({{{8, 0, 0}}, {{17, 1, 1}}}), (std::vector<Index3>{{{8, 0, 0}}, {{16, 0, 0}}}));
  EXPECT_DOUBLE_EQ(level.period(0), 1.0);
}

TEST(Level, LeavesOutAPeriodicAxisOfOneCell) {
  Domain ring = domain({{8, 1, 1}});
  ring.boundaries.faces[2].clear();
  ring.boundaries.faces[3].clear();
  ring.periodic[1] = 1;

  EXPECT_EQ(Level(ring).dimension(), 1);
}

}  // namespace tushar::grid
