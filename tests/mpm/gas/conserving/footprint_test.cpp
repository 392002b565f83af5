#include "components/mpm/gas/conserving/footprint.hpp"

#include <gtest/gtest.h>

#include "tests/mpm/gas/conserving/boxes.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

grid::Domain line(int cells) {
  grid::Domain domain;
  domain.lower = {-1, 0, 0};
  domain.upper = {2, 0, 0};
  domain.resolution = {{cells, 1, 1}};
  return domain;
}

using Interval = Span<2>;

Interval intervalAt(const Level& level, double centre, double length) {
  return Interval(level, 0, LaneIntegers{} + level.cellAlong(0, centre), centre, length);
}

/// Returns the sum of the first `count` values.
double sumOf(const auto& values, int count) {
  double sum = 0;
  for (int k = 0; k < count; ++k) sum += values[k][0];
  return sum;
}

}  // namespace

TEST(Span, PartsAndWeightsSumToOneWhereverAndHoweverLong) {
  const Level level(line(30));
  for (double centre = -0.95; centre < 2; centre += 0.0173)
    for (double length = 0.003; length < 0.29; length += 0.0217) {
      const Interval span = intervalAt(level, centre, length);
      EXPECT_NEAR(sumOf(span.part, span.cells), 1, 1e-13) << centre << ' ' << length;
      EXPECT_NEAR(sumOf(span.weight, span.nodes()), 1, 1e-13) << centre << ' ' << length;
      EXPECT_NEAR(sumOf(span.atLower, span.nodes()), 1, 1e-13) << centre << ' ' << length;
      EXPECT_NEAR(sumOf(span.atUpper, span.nodes()), 1, 1e-13) << centre << ' ' << length;
    }
}

TEST(Span, ReproducesPositionsOnAverageAndAtItsEnds) {
  const Level level(line(30));
  for (double centre = -0.8; centre < 1.8; centre += 0.0131)
    for (const double length : {0.01, 0.1, 0.17, 0.28}) {
      const Interval span = intervalAt(level, centre, length);
      Lanes mean = 0, lower = 0, upper = 0, square = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(span.nodes()); ++k) {
        mean += span.weight[k] * span.arm[k];
        lower += span.atLower[k] * span.arm[k];
        upper += span.atUpper[k] * span.arm[k];
        square += span.weight[k] * span.arm[k] * span.arm[k];
      }
      EXPECT_NEAR(mean[0], 0, 1e-14);
      EXPECT_NEAR(lower[0], -0.5 * length, 1e-14);
      EXPECT_NEAR(upper[0], 0.5 * length, 1e-14);
      EXPECT_NEAR(span.inertia[0], square[0], 1e-16);
    }
}

TEST(Span, TouchesOneCellWhereItFillsThatCell) {
  const Level level(line(30));
  const Interval span = intervalAt(level, level.cellCentre<1>({{11}})[0], level.spacing(0));

  EXPECT_EQ(span.first[0], 11);
  EXPECT_EQ(span.cells, 1);
  EXPECT_NEAR(span.weight[0][0], 0.5, 1e-15);
  EXPECT_NEAR(span.inertia[0], 0.25 * level.spacing(0) * level.spacing(0), 1e-16);
}

TEST(Span, IsCutOffAtTheEndsOfTheGrid) {
  const Level level(line(30));
  const Interval span = intervalAt(level, 1.98, 0.1);

  EXPECT_DOUBLE_EQ(span.upper[0], 2.0);
  EXPECT_NEAR(span.lower[0], 1.93, 1e-15);
  EXPECT_NEAR(sumOf(span.part, span.cells), 1, 1e-13);
}

TEST(Span, GoesOnBeyondAPeriodicEnd) {
  grid::Domain ring = line(30);
  ring.periodic[0] = 1;
  const Level level(ring);
  const Interval span = intervalAt(level, 1.98, 0.1);

  EXPECT_EQ(span.first[0], 29);
  EXPECT_EQ(span.cells, 2);
  EXPECT_NEAR(span.part[1][0], 0.3, 1e-12);
}

TEST(Span, KeepsAllOfAnIntervalThatIsTooLong) {
  const Level level(line(30));
  const Interval span = intervalAt(level, 0.51, 0.7);

  EXPECT_EQ(span.first[0], 13);
  EXPECT_EQ(span.cells, 5);
  EXPECT_NEAR(sumOf(span.part, 5), 1, 1e-13);
  EXPECT_NEAR(sumOf(span.weight, 6), 1, 1e-13);
}

TEST(Span, OfTheMirrorImageHasTheMirroredBits) {
  grid::Domain mirrored = line(30);
  mirrored.lower[0] = -2;
  mirrored.upper[0] = 1;
  const Level level(line(30)), there(mirrored);
  for (double centre = -0.987; centre < 2; centre += 0.0131)
    for (const double length : {0.03, 0.1, 0.17, 0.28}) {
      const Interval span = intervalAt(level, centre, length), image = intervalAt(there, -centre, length);
      ASSERT_EQ(image.cells, span.cells);
      for (std::size_t k = 0, last = static_cast<std::size_t>(span.cells); k <= last; ++k) {
        EXPECT_EQ(span.weight[k][0], image.weight[last - k][0]);
        EXPECT_EQ(span.arm[k][0], -image.arm[last - k][0]);
        EXPECT_EQ(span.atLower[k][0], image.atUpper[last - k][0]);
        EXPECT_EQ(k < last ? span.part[k][0] : 0, k < last ? image.part[last - 1 - k][0] : 0);
      }
      EXPECT_EQ(span.inertia[0], image.inertia[0]);
    }
}

TEST(Span, HasNothingInCellsThatOnlyOthersReach) {
  const Level level(line(30));
  Lanes length = 0.02;
  length = Lanes::of([&](int lane) { return lane == 1 ? 0.25 : length[lane]; });
  const Interval span(level, 0, LaneIntegers{} + 15, 0.55, length);

  EXPECT_EQ(span.cells, 3);
  EXPECT_EQ(span.first[0], 14);
  EXPECT_EQ(span.part[0][0], 0);
  EXPECT_NEAR(span.part[1][0], 1, 1e-13);
  EXPECT_EQ(span.part[2][0], 0);
  EXPECT_EQ(span.weight[0][0], 0);
  EXPECT_EQ(span.weight[3][0], 0);
  EXPECT_NEAR(span.part[1][1], 0.4, 1e-13);
}

TEST(Footprint, IsTheProductOfItsSpans) {
  const Level level(test::domain({{8, 6, 4}}));
  const Footprint<3> footprint = footprintOf<3>(level, Vec<3>(0.4, 0.31, 0.19), Vec<3>(0.15, 0.12, 0.09));
  Lanes parts = 0, weights = 0;
  Footprint<3>::Field<2> still;
  still.fill(LanesVec<3>::Zero());
  footprint.forEachPart([&](const Index<3>&, const Lanes& part) { parts += part; });
  footprint.forEachRowOfNodes(still, [&](const Index<3>&, const Lanes& w, const auto&) {
    for (int k = 0; k < footprint.along[0].nodes(); ++k) weights += w * footprint.along[0].weight[k];
  });

  EXPECT_NEAR(parts[0], 1, 1e-14);
  EXPECT_NEAR(weights[0], 1, 1e-14);
}

TEST(Footprint, EvaluatesMultilinearFieldsAtTheNodes) {
  const Level level(test::domain({{8, 6, 1}}));
  const Vec<2> centre(0.4, 0.31), mean(1, 2), alongX(3, -1), alongY(0.5, 4), mixed(-2, 7);
  const Footprint<2> footprint = footprintOf<2>(level, centre, Vec<2>(0.15, 0.12));
  const Footprint<2>::Field<1> field{LanesVec<2>(mean.cast<Lanes>()), alongX.cast<Lanes>(), alongY.cast<Lanes>(),
                                     mixed.cast<Lanes>()};
  footprint.forEachRowOfNodes(field, [&](const Index<2>& row, const Lanes&, const Footprint<2>::Field<0>& along) {
    const double y = level.nodePosition(1, footprint.along[1].first[0] + row[1]) - centre[1];
    for (int k = 0; k < footprint.along[0].nodes(); ++k) {
      const double x = level.nodePosition(0, footprint.along[0].first[0] + k) - centre[0];
      const Vec<2> there = mean + x * alongX + y * alongY + x * y * mixed;
      const LanesVec<2> value = along[0] + footprint.along[0].arm[k] * along[1];
      for (int d = 0; d < 2; ++d) EXPECT_NEAR(value[d][0], there[d], 1e-14);
    }
  });
}

}  // namespace tushar::mpm::gas::conserving
