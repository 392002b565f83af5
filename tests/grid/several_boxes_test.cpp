#include "core/grid/several_boxes.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/grid/box_conflicts.hpp"
#include "core/grid/grid.hpp"
#include "core/grid/nodes_of_sides.hpp"
#include "core/grid/passed_sides.hpp"

namespace tushar::grid {
namespace {

/// A lower box of 10 x 6 cells, and on its left part a shaft of 4 x 5 cells.
const std::vector<Box> angle{{{}, {{10, 6, 1}}}, {{{0, 6, 0}}, {{4, 11, 1}}}};

Domain domainOf(std::vector<Box> boxes, int nodesBeyond = 1) {
  Domain domain;
  domain.upper = {10, 11, 0};
  domain.resolution = {{10, 11, 1}};
  domain.boxes = std::move(boxes);
  domain.nodesBeyond = nodesBeyond;
  return domain;
}

SeveralBoxes angleWith(int layers) { return {angle, {{}, {{10, 11, 1}}}, 2, layers}; }

using Places = std::set<std::pair<int, int>>;

Places placesOf(const std::vector<SeveralBoxes::Nodes>& all) {
  Places places;
  std::size_t count = 0;
  for (const SeveralBoxes::Nodes& nodes : all)
    forEach<2>(nodes.box, [&](const Index<2>& node) {
      places.emplace(node[0], node[1]);
      ++count;
    });
  EXPECT_EQ(places.size(), count) << "the boxes of nodes overlap";
  return places;
}

/// The places with x from `left` to `right` and y from `low` to `high`.
Places range(int left, int right, int low, int high) {
  Places places;
  for (int x = left; x <= right; ++x)
    for (int y = low; y <= high; ++y) places.emplace(x, y);
  return places;
}

TEST(SeveralBoxes, KnowTheirCellsAndNodes) {
  const Level level(domainOf(angle));

  EXPECT_TRUE(level.isInside<2>({{9, 5}}));
  EXPECT_TRUE(level.isInside<2>({{3, 10}}));
  EXPECT_FALSE(level.isInside<2>({{4, 6}}));
  EXPECT_FALSE(level.isInside<2>({{-1, 0}}));
  EXPECT_TRUE(level.isNodeInside<2>({{4, 11}}));
  EXPECT_FALSE(level.isNodeInside<2>({{5, 7}}));
  EXPECT_EQ(level.cellsInside(), 80U);
}

TEST(SeveralBoxes, AreTakenAlongTheAxesInUse) {
  Domain domain;
  domain.upper = {0, 11, 10};
  domain.resolution = {{1, 11, 10}};
  domain.boxes = {{{}, {{1, 6, 10}}}, {{{0, 6, 0}}, {{1, 11, 4}}}};
  const Level level(domain);

  EXPECT_TRUE(level.isInside<2>({{10, 3}}));
  EXPECT_FALSE(level.isInside<2>({{6, 4}}));
}

TEST(SeveralBoxes, HaveConditionsOnInnerSidesButNotAtReentrantEdges) {
  const SeveralBoxes boxes = angleWith(0);

  EXPECT_EQ(placesOf(boxes.onSide(0, 1)), range(4, 4, 7, 11));
  EXPECT_EQ(placesOf(boxes.onSide(1, 1)), range(5, 10, 6, 6));
  EXPECT_TRUE(boxes.onSide(0, 0).empty());
  EXPECT_TRUE(boxes.onSide(1, 0).empty());
  EXPECT_TRUE(boxes.beyondSide(0, 1).empty());
}

TEST(SeveralBoxes, HaveALayerOfNodesBeyondForWideShapeFunctions) {
  const SeveralBoxes boxes = angleWith(1);

  EXPECT_EQ(placesOf(boxes.onSide(0, 1)), range(4, 4, 7, 12)) << "and those beyond the side of the grid";
  EXPECT_EQ(placesOf(boxes.onSide(1, 1)), range(5, 11, 6, 6));
  EXPECT_EQ(placesOf(boxes.beyondSide(0, 1)), range(5, 5, 8, 12)) << "(5, 7) is beyond both walls of the edge";
  EXPECT_EQ(placesOf(boxes.beyondSide(1, 1)), range(6, 11, 7, 7));
  for (const SeveralBoxes::Nodes& nodes : boxes.beyondSide(0, 1)) EXPECT_EQ(nodes.plane, 4);
}

TEST(SeveralBoxes, HaveNodesBeyondConvexEdgesInside) {
  // A step up and down: the upper box ends on both sides within the lower one.
  const SeveralBoxes boxes({{{}, {{12, 4, 1}}}, {{{4, 4, 0}}, {{8, 8, 1}}}, {{{4, 8, 0}}, {{12, 12, 1}}}},
                           {{}, {{12, 12, 1}}}, 2, 1);

  EXPECT_EQ(placesOf(boxes.onSide(1, 0)), range(9, 13, 8, 8)) << "the lower side of the third box";
  EXPECT_EQ(placesOf(boxes.onSide(0, 0)), range(4, 4, 5, 13));
  EXPECT_EQ(placesOf(boxes.beyondSide(0, 1)), range(9, 9, 6, 6)) << "between two re-entrant edges";
}

TEST(SeveralBoxes, LeaveOutTheCornersOfAShaftInSpace) {
  const SeveralBoxes boxes({{{}, {{8, 4, 12}}}, {{{0, 4, 4}}, {{4, 10, 8}}}}, {{}, {{8, 10, 12}}}, 3, 0);
  std::set<std::array<int, 3>> ceiling;
  for (const SeveralBoxes::Nodes& nodes : boxes.onSide(1, 1))
    forEach<3>(nodes.box, [&](const Index3& node) { ceiling.insert(node.at); });

  EXPECT_EQ(ceiling.size(), 9U * 13 - 5 * 5);
  EXPECT_FALSE(ceiling.contains({4, 4, 4}));
  EXPECT_FALSE(ceiling.contains({2, 4, 8}));
  EXPECT_TRUE(ceiling.contains({2, 4, 9}));
}

TEST(SeveralBoxes, KeepCutsAwayFromInnerSides) {
  const SeveralBoxes boxes = angleWith(1);

  EXPECT_EQ(boxes.allowedCuts(0, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}), (std::vector<int>{0, 1, 2, 6, 7, 8, 9, 10}));
  EXPECT_EQ(boxes.allowedCuts(0, {0, 5, 10}), (std::vector<int>{0, 6, 10}));
  EXPECT_EQ(boxes.allowedCuts(1, {0, 6, 11}), (std::vector<int>{0, 4, 11}));
  EXPECT_EQ(boxes.allowedCuts(1, {0, 11}), (std::vector<int>{0, 11}));
}

TEST(SeveralBoxes, DivideTheGridOnlyThere) {
  Domain domain = domainOf(angle);
  domain.patches = {{10, 2, 1}};
  const Grid grid(domain);

  EXPECT_EQ(grid.patchCount(), 7 * 2);
}

TEST(SeveralBoxes, GiveEachPatchItsNodesOfTheirSides) {
  Domain domain = domainOf(angle);
  domain.patches = {{2, 2, 1}};  // cut at 6 and 4
  const Grid grid(domain);
  const Patch patch = grid.patchOf({{0, 10, 0}}, 0), other = grid.patchOf({{9, 0, 0}}, 0);
  Places on, beyond;

  forEachBoxOnSide(patch, 0, 1, [&](const Box& nodes) {
    forEach<2>(nodes, [&](const Index<2>& node) { on.emplace(node[0], node[1]); });
  });
  forEachBoxBeyond(patch, 0, 1, [&](const Box& nodes, int face) {
    EXPECT_EQ(face, 4);
    forEach<2>(nodes, [&](const Index<2>& node) { beyond.emplace(node[0], node[1]); });
  });

  EXPECT_EQ(on, range(4, 4, 7, 12));
  EXPECT_EQ(beyond, range(5, 5, 8, 12));
  EXPECT_TRUE(isOnSide<2>(patch, 0, 1, {{4, 7}}));
  EXPECT_FALSE(isOnSide<2>(patch, 0, 1, {{4, 6}}));
  EXPECT_TRUE(isOnSide<2>(other, 0, 1, {{10, 2}})) << "the side of the grid";
}

TEST(SeveralBoxes, MustShareFacesAndNotOverlap) {
  using Kind = BoxConflict::Kind;
  const auto kindOf = [](const std::vector<Box>& boxes) {
    const auto conflict = conflictOf(boxes);
    return conflict ? std::optional(conflict->kind) : std::nullopt;
  };
  const Box first{{}, {{10, 6, 1}}};

  EXPECT_EQ(kindOf(angle), std::nullopt);
  EXPECT_EQ(kindOf({first, {{{0, 5, 0}}, {{4, 11, 1}}}}), Kind::overlap);
  EXPECT_EQ(kindOf({first, {{{0, 7, 0}}, {{4, 11, 1}}}}), Kind::apart);
  EXPECT_EQ(kindOf({first, {{{10, 6, 0}}, {{14, 11, 1}}}}), Kind::apart) << "they share only an edge";
}

TEST(SeveralBoxes, AreThreeCellsApartWhereTheyDoNotShareFaces) {
  const auto conflictWithGap = [](int gap) {
    return conflictOf({{{}, {{12, 2, 1}}}, {{{0, 2, 0}}, {{4, 9, 1}}}, {{{4 + gap, 2, 0}}, {{12, 9, 1}}}});
  };

  for (const int gap : {1, 2}) {
    const auto conflict = conflictWithGap(gap);
    ASSERT_TRUE(conflict);
    EXPECT_EQ(conflict->kind, BoxConflict::Kind::close);
    EXPECT_EQ(conflict->box, 2U);
    EXPECT_EQ(conflict->other, 1U);
  }
  EXPECT_FALSE(conflictWithGap(3));
  EXPECT_FALSE(conflictWithGap(0)) << "they share faces";
  EXPECT_FALSE(conflictOf({{{}, {{4, 4, 1}}}, {{{4, 0, 0}}, {{8, 4, 1}}}, {{{4, 4, 0}}, {{8, 8, 1}}}}))
      << "the second joins the two that share an edge";
}

TEST(PassedSides, AreThoseThatAParticleMeetsAlongAnAxis) {
  const Level level(domainOf(angle));
  const auto sides = [&](const Index<2>& from, const Index<2>& to) {
    std::vector<std::array<int, 3>> found;
    for (const auto& one : passedSides<2>(level, from, to)) found.push_back({one.axis, one.side, one.plane});
    return found;
  };
  using Found = std::vector<std::array<int, 3>>;

  EXPECT_EQ(sides({{3, 8}}, {{4, 8}}), (Found{{0, 1, 4}}));
  EXPECT_EQ(sides({{3, 8}}, {{6, 9}}), (Found{{0, 1, 4}})) << "several cells in a step";
  EXPECT_EQ(sides({{7, 5}}, {{6, 6}}), (Found{{1, 1, 6}}));
  EXPECT_EQ(sides({{3, 5}}, {{4, 6}}), (Found{{0, 1, 4}, {1, 1, 6}})) << "past the re-entrant edge";
  EXPECT_EQ(sides({{0, 10}}, {{-1, 11}}), (Found{{0, 0, 0}, {1, 1, 11}})) << "sides of the grid";
  EXPECT_EQ(sides({{3, 8}}, {{2, 8}}), Found{});
}

TEST(PassedSides, LeaveAParticleOnAnUpperSideInside) {
  const Level level(domainOf(angle));
  const auto cellOf = [&](const Index<2>& from, const Vec<2>& x) {
    return withUpperSides<2>(level, from, x, level.cellOf<2>(x));
  };

  EXPECT_EQ(cellOf({{3, 8}}, {4.0, 8.5}), (Index<2>{{3, 8}}));
  EXPECT_EQ(cellOf({{7, 5}}, {7.5, 6.0}), (Index<2>{{7, 5}}));
  EXPECT_EQ(cellOf({{7, 5}}, {7.5, 6.1}), (Index<2>{{7, 6}}));
  EXPECT_EQ(cellOf({{3, 5}}, {4.0, 5.5}), (Index<2>{{4, 5}})) << "inside, where boxes meet";
}

}  // namespace
}  // namespace tushar::grid
