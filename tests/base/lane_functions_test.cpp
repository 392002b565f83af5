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

TEST(LaneFunctions, TreatLanesByThemselves) {
  const Lanes mixed = Lanes::of([](int lane) { return 0.3 * lane; });
  for (int lane = 0; lane < Lanes::count; ++lane)
    EXPECT_EQ(exponential(mixed)[lane], exponential(Lanes(0.3 * lane))[0]);
}

}  // namespace
}  // namespace tushar
