#include "components/analysis/slice.hpp"

#include <gtest/gtest.h>

namespace tushar::analysis {
namespace {

TEST(Slice, ReadsAPlane) {
  for (const char* text : {"y=-0.5", " y = -.5 ", "y =-5e-1"}) {
    const auto plane = planeOf(text);
    ASSERT_TRUE(plane) << text;
    EXPECT_EQ(plane->axis, 1);
    EXPECT_EQ(plane->at, -0.5);
  }
  for (const char* text : {"", "y", "y=", "w=1", "=1", "y=1m", "1=y", "y=inf", "yy=1"})
    EXPECT_FALSE(planeOf(text)) << text;
}

TEST(Slice, ShowsTheCellsThatThePlaneCutsAndTheNearestNodes) {
  grid::Domain domain;
  domain.lower = {0, 0, -1};
  domain.upper = {2, 1, 1};
  domain.resolution = {{4, 3, 8}};
  const grid::Level level(domain);
  struct Case {
    double z;
    int cell, node;
  };
  for (const Case& expected : {Case{-1, 0, 0}, Case{-.9, 0, 0}, Case{-.8, 0, 1}, Case{-.75, 0, 1}, Case{-.7, 1, 1},
                               Case{-.625, 1, 1}, Case{0, 3, 4}, Case{.99, 7, 8}, Case{1, 7, 8}}) {
    const collect::Layer layer = layerAt({2, expected.z}, level);
    EXPECT_EQ(level.axis(layer.axis), 2);
    EXPECT_EQ(layer.cell, expected.cell) << expected.z;
    EXPECT_EQ(layer.node, expected.node) << expected.z;
  }
}

}  // namespace
}  // namespace tushar::analysis
