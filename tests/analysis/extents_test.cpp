#include "components/analysis/extents.hpp"

#include <gtest/gtest.h>

namespace tushar::analysis {
namespace {

/// A domain of 10 x 1 x 5 cells of .1 m; the y axis is not in use.
grid::Domain domain() {
  grid::Domain domain;
  domain.upper = {1, 0, .5};
  domain.resolution = {{10, 1, 5}};
  return domain;
}

Extent extent(const Vec3& start, const Vec3& end) {
  Extent extent;
  extent.name = "one";
  extent.start = start;
  extent.end = end;
  return extent;
}

TEST(Extents, ALineHasTheCellsThatItGoesThrough) {
  const grid::Level level(domain());
  ASSERT_EQ(level.dimension(), 2);
  const grid::Box whole = cellsOf(extent({0, 0, .25}, {1, 0, .25}), level);
  EXPECT_EQ(whole.lower, (Index3{{0, 2, 0}}));
  EXPECT_EQ(whole.upper, (Index3{{10, 3, 1}}));
  const grid::Box part = cellsOf(extent({.15, 0, .5}, {.3, 0, .5}), level);
  EXPECT_EQ(part.lower, (Index3{{1, 4, 0}})) << "the last row, though the line is its upper side";
  EXPECT_EQ(part.upper, (Index3{{3, 5, 1}})) << ".3 is the side of cell 3, which it does not reach";
}

TEST(Extents, AnIndexAndAPlaceHaveTheAxesOfTheScene) {
  const grid::Level level(domain());
  EXPECT_EQ(sceneIndex({{3, 4, 0}}, level), (Index3{{3, 0, 4}}));
  EXPECT_LT((placeOf({{3, 4, 0}}, false, level) - Vec3(.35, 0, .45)).norm(), 1e-15);
  EXPECT_LT((placeOf({{3, 4, 0}}, true, level) - Vec3(.3, 0, .4)).norm(), 1e-15);
}

TEST(Extents, WhatTheGridCannotShowIsRefused) {
  const grid::Level level(domain());
  const auto problem = [&](const Extent& one, int axes) {
    try {
      checkExtents({one}, axes, level);
    } catch (const InputError& error) {
      return error.problems().front().sentence;
    }
    return std::string();
  };
  EXPECT_EQ(problem(extent({0, 0, .2}, {1, 0, .2}), 1), "");
  EXPECT_EQ(problem(extent({0, 0, .1}, {1, 0, .2}), 2), "");
  EXPECT_TRUE(problem(extent({0, 0, .1}, {1, 0, .2}), 1).starts_with("a line is parallel to one axis"));
  EXPECT_TRUE(problem(extent({0, 0, .1}, {1, 0, .1}), 2).starts_with("a plane is parallel to two axes"));
  EXPECT_EQ(problem(extent({-.1, 0, .2}, {1.1, 0, .2}), 1), "") << "in the layer of cells beyond the sides";
  EXPECT_EQ(problem(extent({0, 0, .2}, {1.5, 0, .2}), 1),
            "found x from 0 to 1.5 m, expected positions on the grid, from 0 to 1 m");
  EXPECT_EQ(problem(extent({1, 0, .2}, {0, 0, .2}), 1),
            "found endingPt at x = 0 m, expected 1 m or more, the coordinate of startingPt");
  Extent named = extent({0, 0, .2}, {1, 0, .2});
  for (const char* name : {"", "a/b", "..", "checkpoints", "t00001", "index.xml"}) {
    named.name = name;
    EXPECT_TRUE(problem(named, 1).starts_with("name: found")) << name;
  }
}

}  // namespace
}  // namespace tushar::analysis
