#include "core/base/lane_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tushar {
namespace {

TEST(LaneFunctions, ExponentialHasTheErrorItStates) {
  for (double x = 0; x <= 700; x += 0.0137) {
    const long double exact = std::exp(static_cast<long double>(x));
    EXPECT_LE(std::abs(exponential(x)[0] / exact - 1), 2e-16L) << x;
  }
  EXPECT_EQ(exponential(0.0)[0], 1);
}

TEST(LaneFunctions, HyperbolicTangentHasTheErrorItStates) {
  for (double x = 1e-9; x < 50; x *= 1.0007) {
    const long double exact = std::tanh(static_cast<long double>(x));
    EXPECT_LE(std::abs(hyperbolicTangent(x)[0] - exact), 3e-16L) << x;
    EXPECT_EQ(hyperbolicTangent(-x)[0], -hyperbolicTangent(x)[0]) << x;
  }
  EXPECT_EQ(hyperbolicTangent(0.0)[0], 0);
  EXPECT_EQ(hyperbolicTangent(1e300)[0], 1);
}

TEST(LaneFunctions, TreatLanesByThemselves) {
  const Lanes mixed = Lanes::of([](int lane) { return 0.3 * lane - 0.5; });
  for (int lane = 0; lane < Lanes::count; ++lane)
    EXPECT_EQ(hyperbolicTangent(mixed)[lane], hyperbolicTangent(Lanes(0.3 * lane - 0.5))[0]);
}

}  // namespace
}  // namespace tushar
