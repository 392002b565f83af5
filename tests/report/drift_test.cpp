#include "core/report/drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tushar::report {

TEST(Drift, OfANumberKeepsItsSignAndIsRelativeToTheStart) {
  const Drift drift = driftOf("energy", {-4}, {-5}, "J");

  EXPECT_EQ(drift.start, -4);
  EXPECT_EQ(drift.end, -5);
  EXPECT_EQ(drift.change, -0.25);
  EXPECT_TRUE(drift.relative);
  EXPECT_EQ(drift.unit, "J");
}

TEST(Drift, OfAVectorIsThatOfMagnitudes) {
  const Drift drift = driftOf("momentum", {3, 4}, {3, 7}, "kg m/s");

  EXPECT_EQ(drift.start, 5);
  EXPECT_EQ(drift.end, std::sqrt(58.0));
  EXPECT_EQ(drift.change, 3.0 / 5);
}

TEST(Drift, FromNothingIsAbsolute) {
  const Drift drift = driftOf("momentum", {0, 0}, {0, 2}, "kg m/s");

  EXPECT_FALSE(drift.relative);
  EXPECT_EQ(drift.change, 2);
}

TEST(Drift, FromRoundOffIsAbsolute) {
  const Drift grown = driftOf("momentum", {1.3e-17, 0}, {0, 2}, "kg m/s");
  EXPECT_FALSE(grown.relative);
  EXPECT_EQ(grown.change, 2);

  const Drift still = driftOf("momentum", {1.3e-17}, {2.3e-17}, "kg m/s", 0.5);
  EXPECT_FALSE(still.relative);
  EXPECT_DOUBLE_EQ(still.change, 1e-17);
  EXPECT_TRUE(driftOf("momentum", {1e-9}, {2e-9}, "kg m/s", 0.5).relative);
}

TEST(Drift, BelowTheDigitsOfSumsIsNone) {
  EXPECT_EQ(driftOf("momentum", {0}, {1.04e-53}, "kg m/s", 0.5).change, 0);
  EXPECT_EQ(driftOf("momentum", {0}, {1e-44}, "kg m/s", 0.5).change, 1e-44);
}

}  // namespace tushar::report
