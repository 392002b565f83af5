#include "components/mpm/conserving/footprint.hpp"

#include <gtest/gtest.h>

#include "tests/support/levels.hpp"

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

using Interval = Span<4>;

}  // namespace

TEST(Span, PartsAndWeightsSumToOneWhereverAndHoweverLong) {
  const Level level(line(30));
  for (double centre = -0.95; centre < 2; centre += 0.0173)
    for (double length = 0.003; length < 0.29; length += 0.0217) {
      const Interval span(level, 0, level.cellAlong(0, centre), centre, length);
      EXPECT_NEAR(sumOf(span.part), 1, 1e-13) << centre << ' ' << length;
      EXPECT_NEAR(sumOf(span.weight), 1, 1e-13) << centre << ' ' << length;
      EXPECT_NEAR(sumOf(span.atLower), 1, 1e-13) << centre << ' ' << length;
      EXPECT_NEAR(sumOf(span.atUpper), 1, 1e-13) << centre << ' ' << length;
    }
}

TEST(Span, ReproducesPositionsOnAverageAndAtItsEnds) {
  const Level level(line(30));
  for (double centre = -0.8; centre < 1.8; centre += 0.0131)
    for (const double length : {0.01, 0.1, 0.17, 0.28}) {
      const Interval span(level, 0, level.cellAlong(0, centre), centre, length);
      double mean = 0, lower = 0, upper = 0, square = 0;
      for (std::size_t k = 0; k < span.weight.size(); ++k) {
        mean += span.weight[k] * span.arm[k];
        lower += span.atLower[k] * span.arm[k];
        upper += span.atUpper[k] * span.arm[k];
        square += span.weight[k] * span.arm[k] * span.arm[k];
      }
      EXPECT_NEAR(mean, 0, 1e-14);
      EXPECT_NEAR(lower, -0.5 * length, 1e-14);
      EXPECT_NEAR(upper, 0.5 * length, 1e-14);
      EXPECT_NEAR(span.inertia, square, 1e-16);
    }
}

TEST(Span, TouchesOneCellWhereItFillsThatCell) {
  const Level level(line(30));
  const Interval span(level, 0, 11, level.cellCentre<1>({{11}})[0], level.spacing(0));

  EXPECT_EQ(span.first, 11);
  EXPECT_EQ(span.cells, 1);
  EXPECT_NEAR(span.weight[0], 0.5, 1e-15);
  EXPECT_NEAR(span.inertia, 0.25 * level.spacing(0) * level.spacing(0), 1e-16);
}

TEST(Span, IsCutOffAtTheEndsOfTheGrid) {
  const Level level(line(30));
  const Interval span(level, 0, 29, 1.98, 0.1);

  EXPECT_DOUBLE_EQ(span.upper, 2.0);
  EXPECT_NEAR(span.lower, 1.93, 1e-15);
  EXPECT_NEAR(sumOf(span.part), 1, 1e-13);
}

TEST(Span, GoesOnBeyondAPeriodicEnd) {
  grid::Domain ring = line(30);
  ring.periodic[0] = 1;
  const Level level(ring);
  const Interval span(level, 0, 29, 1.98, 0.1);

  EXPECT_EQ(span.first, 29);
  EXPECT_EQ(span.cells, 2);
  EXPECT_NEAR(span.part[1], 0.3, 1e-12);
}

TEST(Footprint, IsTheProductOfItsSpans) {
  const Level level(test::domain({{8, 6, 4}}));
  const Vec<3> centre(0.4, 0.31, 0.19), edges(0.15, 0.12, 0.09);
  const Footprint<3> footprint(level, level.cellOf<3>(centre), centre, edges);
  double parts = 0, weights = 0;
  footprint.forEachCell(level.cells(), [&](const Index<3>&, double part) { parts += part; });
  footprint.forEachNode(level.nodes(), {}, [&](const Index<3>&, double w, const Vec<3>&) { weights += w; });

  EXPECT_NEAR(parts, 1, 1e-14);
  EXPECT_NEAR(weights, 1, 1e-14);
}

TEST(Footprint, EvaluatesMultilinearFieldsAtTheNodes) {
  const Level level(test::domain({{8, 6, 1}}));
  const Vec<2> centre(0.4, 0.31), edges(0.15, 0.12);
  const Footprint<2> footprint(level, level.cellOf<2>(centre), centre, edges);
  const Footprint<2>::Field<1> field{Vec<2>(1, 2), Vec<2>(3, -1), Vec<2>(0.5, 4), Vec<2>(-2, 7)};
  footprint.forEachNode(level.nodes(), field, [&](const Index<2>& node, double, const Vec<2>& value) {
    const double x = level.nodePosition(0, node[0]) - centre[0], y = level.nodePosition(1, node[1]) - centre[1];
    EXPECT_NEAR((value - (field[0] + x * field[1] + y * field[2] + x * y * field[3])).norm(), 0, 1e-14);
  });
}

TEST(Footprint, VisitsTheSameWithinABoxAsWithout) {
  const Level level(test::domain({{8, 6, 1}}));
  const Vec<2> centre(0.4, 0.31), edges(0.15, 0.12);
  const Footprint<2> footprint(level, level.cellOf<2>(centre), centre, edges);
  const Box some{{{3, 0, 0}}, {{4, 3, 1}}};
  std::vector<double> clipped, chosen;
  footprint.forEachCell(some, [&](const Index<2>&, double part) { clipped.push_back(part); });
  footprint.forEachCell(level.cells(), [&](const Index<2>& cell, double part) {
    if (some.contains(cell)) chosen.push_back(part);
  });

  EXPECT_EQ(clipped, chosen);
  EXPECT_FALSE(clipped.empty());
}

}  // namespace tushar::mpm
