#include "components/ice/scalar_decay.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tushar::ice {
namespace {

double fallen(double f, double r0, double k, double dt) { return Fall(r0, k, dt)(f); }

TEST(ScalarDecay, IsTheClosedForm) {
  for (const double k : {-2.0, 1e-9, 0.7, 40.0})
    for (const double r0 : {-3.0, 0.0, 0.2})
      for (const double dt : {1e-6, 0.1}) {
        const double exact = (5 + r0 / k) * std::exp(-k * dt) - r0 / k;
        EXPECT_NEAR(fallen(5, r0, k, dt), exact, 1e-15 * (5 + std::abs(r0 / k)) * 4) << k << ' ' << r0 << ' ' << dt;
      }
  EXPECT_DOUBLE_EQ(fallen(5, 0.5, 0, 2), 4);
}

TEST(ScalarDecay, OfAnAmountIsThatOfTheValueTimesTheMass) {
  EXPECT_NEAR(Fall(0.3, 2, 0.1)(5 * 1.2, 1.2), 1.2 * fallen(5, 0.3, 2, 0.1), 2e-15);
  EXPECT_EQ(Fall(0.3, 2, 0.1)(0, 0), 0);
}

/// The formula with r0 / k would have lost all digits.
TEST(ScalarDecay, TendsToALineAsTheExponentVanishes) {
  EXPECT_DOUBLE_EQ(fallen(1, 0.5, 1e-20, 0.1), 0.95);
  EXPECT_DOUBLE_EQ(fallen(1, 0.5, 1e-300, 0.1), 0.95);
}

TEST(ScalarDecay, OfTwoHalfStepsIsThatOfOne) {
  const double half = fallen(fallen(5, 0.3, 2, 0.05), 0.3, 2, 0.05);
  EXPECT_NEAR(half, fallen(5, 0.3, 2, 0.1), 2e-15);
}

TEST(ScalarDecay, AtAConstantRateEndsAtZero) {
  EXPECT_EQ(fallen(0.1, 3, 0, 1), 0);
  EXPECT_EQ(fallen(0.1, 3, 2, 1), 0);
  EXPECT_EQ(fallen(0, 3, 2, 1), 0);
  EXPECT_GT(fallen(0, -3, 2, 1), 0);
}

}  // namespace
}  // namespace tushar::ice
