#include "core/base/limiters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace tushar {

namespace {

template <class Limited>
class Limiters : public testing::Test {};
using AllLimiters = testing::Types<Minmod, VanLeer, Mc>;
TYPED_TEST_SUITE(Limiters, AllLimiters);

const std::vector<double> differences{-7, -1.3, -1, -0.2, -1e-9, 0, 1e-150, 1e-9, 0.2, 1, 1.1, 5};

}  // namespace

TYPED_TEST(Limiters, AreSymmetricAndOddToTheLastBit) {
  for (const double a : differences)
    for (const double b : differences) {
      EXPECT_EQ(TypeParam::slope(a, b), TypeParam::slope(b, a));
      EXPECT_EQ(TypeParam::slope(-a, -b), -TypeParam::slope(a, b));
    }
}

TYPED_TEST(Limiters, GiveNoSlopeAtAnExtremumOrBesideAFlat) {
  EXPECT_EQ(TypeParam::slope(1, -2), 0);
  EXPECT_EQ(TypeParam::slope(-0.1, 0.1), 0);
  EXPECT_EQ(TypeParam::slope(0, 3), 0);
  EXPECT_EQ(TypeParam::slope(0, 0), 0);
}

TYPED_TEST(Limiters, KeepALinearProfile) {
  for (const double a : {-2.0, -0.3, 0.7, 4.0}) EXPECT_DOUBLE_EQ(TypeParam::slope(a, a), a);
}

TYPED_TEST(Limiters, StayWithinTheTotalVariationBound) {
  for (const double a : differences)
    for (const double b : differences) {
      const double slope = TypeParam::slope(a, b);
      EXPECT_LE(std::abs(slope), 2 * std::min(std::abs(a), std::abs(b)) * (1 + 1e-15));  // but for round-off
      EXPECT_GE(slope * a, 0);
    }
}

TEST(Limiters, AreOrderedFromMinmodToMc) {
  for (const double ratio : {1.0, 1.2, 2.0, 3.5, 10.0}) {
    EXPECT_LE(Minmod::slope(1, ratio), VanLeer::slope(1, ratio));
    EXPECT_LE(VanLeer::slope(1, ratio), Mc::slope(1, ratio));
  }
}

TEST(Limiters, HaveTheirKnownValues) {
  EXPECT_DOUBLE_EQ(Minmod::slope(1, 3), 1);
  EXPECT_DOUBLE_EQ(VanLeer::slope(1, 3), 1.5);
  EXPECT_DOUBLE_EQ(Mc::slope(1, 3), 2);
  EXPECT_DOUBLE_EQ(Mc::slope(2, 3), 2.5);
}

}  // namespace tushar
