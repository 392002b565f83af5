#include "components/mpmice/tasks/measure_exchange.hpp"

#include "tests/mpmice/fields.hpp"

namespace tushar::mpmice {

TEST(BlockedStrips, OfALineAreAllOrNone) {
  BlockedStrips<1> strips;
  strips.add({Vec<1>(1.5), Vec<1>(0.25)}, Index<1>{0});
  EXPECT_EQ(strips.open(0), 1) << "the box is in the next cell";
  strips.add({Vec<1>(0.5), Vec<1>(0.25)}, Index<1>{0});
  EXPECT_EQ(strips.open(0), 0);
}

TEST(BlockedStrips, OfAPlaneAreThoseBesideTheBox) {
  BlockedStrips<2> strips;
  strips.add({Vec<2>(0.5, 0.125), Vec<2>(0.5, 0.25)}, Index<2>{0, 0});
  EXPECT_EQ(strips.open(0), 0.75);
  EXPECT_EQ(strips.open(1), 0.5);
  strips.add({Vec<2>(0.9, 0.125), Vec<2>(0.1, 0.25)}, Index<2>{0, 0});
  EXPECT_EQ(strips.open(0), 0.75) << "one behind the other";
}

TEST(BlockedStrips, OfSpaceAreThoseBesideTheBox) {
  BlockedStrips<3> strips;
  strips.add({Vec<3>(0.5, 0.125, 0.75), Vec<3>(1, 0.25, 0.5)}, Index<3>{0, 0, 0});
  EXPECT_EQ(strips.open(0), 1 - 0.25 * 0.5);
  EXPECT_EQ(strips.open(1), 1 - 1 * 0.5);
  EXPECT_EQ(strips.open(2), 1 - 1 * 0.25);
}

TEST(LeakAlong, IsWhatGoesThroughWithoutAStraightWay) {
  EXPECT_EQ(leakAlong(2, 1, 0.5, 0.5, 0), 1) << "the lesser of what comes in and goes out";
  EXPECT_EQ(leakAlong(-2, -3, 0.5, 0.5, 0), 2);
  EXPECT_EQ(leakAlong(2, 1, 0.5, 0.75, 0.5), 0) << "past a body";
  EXPECT_EQ(leakAlong(2, 2, 0.5, 0.75, 0.25), 1);
}

TEST(LeakAlong, IsNoneOfWhatFillsACell) {
  EXPECT_EQ(leakAlong(2, -1, 0.5, 0.5, 0), 0);
  EXPECT_EQ(leakAlong(2, 0, 0.5, 0, 0), 0);
}

}  // namespace tushar::mpmice
