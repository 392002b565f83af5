#include "components/mpm/conserving/extent.hpp"

#include <gtest/gtest.h>

namespace tushar::mpm {

namespace {

grid::Domain line(int cells) {
  grid::Domain domain;
  domain.lower = {-1, 0, 0};
  domain.upper = {2, 0, 0};
  domain.resolution = {{cells, 1, 1}};
  return domain;
}

double sumOf(const auto& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

}  // namespace

TEST(Extent, PartsAndWeightsSumToOneWhereverAndHoweverLong) {
  const Level level(line(30));
  for (double centre = -0.95; centre < 2; centre += 0.0173)
    for (double length = 0.003; length < 0.29; length += 0.0217) {
      const Extent extent(level, level.cellAlong(0, centre), centre, length);
      EXPECT_NEAR(sumOf(extent.part), 1, 1e-14) << centre << ' ' << length;
      EXPECT_NEAR(sumOf(extent.weight), 1, 1e-14) << centre << ' ' << length;
    }
}

TEST(Extent, ReproducesLinearFieldsInItsMiddleAndAtItsEnds) {
  const Level level(line(30));
  for (double centre = -0.8; centre < 1.8; centre += 0.0131)
    for (const double length : {0.01, 0.1, 0.17, 0.28}) {
      const Extent extent(level, level.cellAlong(0, centre), centre, length);
      std::array<double, Extent::most + 1> positions{};
      double mean = 0;
      for (int k = 0; k <= extent.cells; ++k) {
        const auto at = static_cast<std::size_t>(k);
        positions[at] = level.nodePosition(0, extent.firstCell + k);
        mean += extent.weight[at] * positions[at];
      }
      EXPECT_NEAR(mean, centre, 1e-14);
      EXPECT_NEAR(extent.atLeft(positions), centre - length / 2, 1e-14);
      EXPECT_NEAR(extent.atRight(positions), centre + length / 2, 1e-14);
    }
}

TEST(Extent, FillsExactlyTheCellsThatItOverlaps) {
  const Level level(line(3));

  const Extent extent(level, 1, 0.5, 1.5);

  EXPECT_EQ(extent.firstCell, 0);
  ASSERT_EQ(extent.cells, 3);
  EXPECT_NEAR(extent.part[0], 1.0 / 6, 1e-15);
  EXPECT_NEAR(extent.part[1], 2.0 / 3, 1e-15);
  EXPECT_NEAR(extent.part[2], 1.0 / 6, 1e-15);
}

TEST(Extent, IsCutAtTheEndsOfTheGrid) {
  const Level level(line(30));

  const Extent extent(level, 0, -0.99, 0.1);

  EXPECT_EQ(extent.left, -1);
  EXPECT_EQ(extent.firstCell, 0);
  EXPECT_NEAR(sumOf(extent.part), 1, 1e-14);
}

}  // namespace tushar::mpm
