#include "components/burgers/burgers_wave.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace tushar::burgers {

namespace {

/// The initial wave 1 + sin(2 pi x) / 2, which breaks at t = 1 / pi where u = 1.
BurgersProblem sine(double viscosity = 0) {
  return {[](double x) { return 1 + 0.5 * std::sin(2 * M_PI * x); }, viscosity, 0, 1, true};
}

/// A step at x = 0 from `left` to `right` on [-1, 1], where 0 is a point of the table.
BurgersProblem step(double left, double right, double viscosity = 0) {
  return {[=](double x) { return x < 0 ? left : right; }, viscosity, -1, 1, false};
}

double midpointMean(const BurgersWave& wave, double lower, double upper, double t, int n) {
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += wave.at(lower + (upper - lower) * (k + 0.5) / n, t);
  return sum / n;
}

}  // namespace

TEST(BurgersWave, CarriesEachValueAtItsOwnSpeedUntilItBreaks) {
  const BurgersWave wave(sine());
  for (const double t : {0.05, 0.2, 0.31})
    for (const double foot : {0.05, 0.3, 0.45, 0.8}) {
      const double u = 1 + 0.5 * std::sin(2 * M_PI * foot);
      EXPECT_NEAR(wave.at(foot + u * t, t), u, 1e-12);
      EXPECT_NEAR(wave.at(foot + u * t + 3, t), u, 1e-12);
    }
}

TEST(BurgersWave, IsItsProfileAtTheStart) {
  const BurgersWave wave(sine(0.01));
  EXPECT_EQ(wave.at(0.3, 0), 1 + 0.5 * std::sin(2 * M_PI * 0.3));
  EXPECT_NEAR(wave.average(0.1, 0.2, 0), 1 + 5 / (2 * M_PI) * (std::cos(0.2 * M_PI) - std::cos(0.4 * M_PI)), 1e-13);
}

TEST(BurgersWave, HasAShockThatMovesWithTheMeanOfItsSides) {
  const BurgersWave wave(step(1.5, 0.5));
  EXPECT_EQ(wave.at(0.29, 0.3), 1.5);
  EXPECT_EQ(wave.at(0.31, 0.3), 0.5);
  EXPECT_NEAR(wave.average(0.2, 0.4, 0.3), 1, 1e-12);
  const BurgersWave broken(sine());
  EXPECT_GT(broken.at(0.99, 0.5), 1.2);
  EXPECT_LT(broken.at(1.01, 0.5), 0.8);
}

TEST(BurgersWave, OpensAFanBetweenAStepUp) {
  const BurgersWave wave(step(-0.5, 1));
  for (const double x : {-0.1, 0.0, 0.15, 0.25}) EXPECT_NEAR(wave.at(x, 0.3), x / 0.3, 1e-12);
  EXPECT_NEAR(wave.average(-0.15, 0.3, 0.3), 0.25, 1e-12);
  EXPECT_EQ(wave.at(0.31, 0.3), 1);
}

TEST(BurgersWave, SmoothsAStepDownAsTheClosedFormDoes) {
  // G. B. Whitham, Linear and Nonlinear Waves (1974), (4.23)-(4.24).
  const double viscosity = 0.01, t = 0.5, left = 1.5, right = 0.5, width = std::sqrt(4 * viscosity * t);
  const BurgersWave wave(step(left, right, viscosity));
  for (const double x : {0.3, 0.45, 0.5, 0.52, 0.6}) {
    const double ratio = std::erfc(-(x - right * t) / width) / std::erfc((x - left * t) / width);
    const double front = std::exp((left - right) * (x - 0.5 * (left + right) * t) / (2 * viscosity));
    // The corner of U at 0 costs the sum step²/12 times the jump of the slope, 1 / 2 nu.
    EXPECT_NEAR(wave.at(x, t), right + (left - right) / (1 + ratio * front), 1e-6);
  }
}

TEST(BurgersWave, SolvesBurgersEquation) {
  const double viscosity = 0.01, d = 1e-3;
  for (const double t : {0.1, 0.5})
    for (const double x : {0.1, 0.45, 0.62, 0.99}) {
      const BurgersWave wave(sine(viscosity));
      const auto at = [&](int i, int k) { return wave.at(x + i * d, t + k * d); };
      const auto slope = [&](double far, double near, double next, double farNext) {
        return (far - 8 * near + 8 * next - farNext) / (12 * d);
      };
      const double inTime = slope(at(0, -2), at(0, -1), at(0, 1), at(0, 2));
      const double along = slope(at(-2, 0), at(-1, 0), at(1, 0), at(2, 0));
      const double curvature = (-at(-2, 0) + 16 * at(-1, 0) - 30 * at(0, 0) + 16 * at(1, 0) - at(2, 0)) / (12 * d * d);
      EXPECT_NEAR(inTime + at(0, 0) * along - viscosity * curvature, 0, 2e-4) << x << " " << t;  // u''' d^4 is 1e-4
    }
}

TEST(BurgersWave, AveragesAsBruteForceDoes) {
  for (const double viscosity : {0.0, 0.01}) {
    const BurgersWave wave(sine(viscosity));
    for (const double lower : {0.1, 0.7, 1.9})
      EXPECT_NEAR(wave.average(lower, lower + 0.05, 0.2), midpointMean(wave, lower, lower + 0.05, 0.2, 200), 1e-6);
  }
}

TEST(BurgersWave, KeepsItsMeanAndLosesEnergyAtTheShock) {
  for (const double viscosity : {0.0, 0.005}) {
    const BurgersWave wave(sine(viscosity));
    double mean = 0, square = 0;
    for (int k = 0; k < 200; ++k) {
      const double u = wave.average(k / 200.0, (k + 1) / 200.0, 0.6);
      mean += u / 200;
      square += u * u / 200;
    }
    EXPECT_NEAR(mean, 1, 1e-12);
    EXPECT_LT(square, 1.1);  // 1.125 at the start
  }
}

TEST(BurgersWave, GoesOverIntoTheOneWithoutViscosity) {
  const BurgersWave thin(sine(1e-5)), none(sine());
  for (const double x : {0.1, 0.4, 0.8}) EXPECT_NEAR(thin.at(x, 0.5), none.at(x, 0.5), 2e-4);
}

TEST(BurgersWave, SaysWhenItsTableIsTooCoarse) {
  const BurgersWave wave(sine(1e-6));
  EXPECT_TRUE(wave.holdsAt(0));
  EXPECT_FALSE(wave.holdsAt(0.01));
  EXPECT_TRUE(wave.holdsAt(0.05));
  EXPECT_THROW(wave.at(0, 0.01), std::domain_error);
  EXPECT_THROW(wave.at(0, -1), std::domain_error);
  EXPECT_TRUE(BurgersWave(sine()).holdsAt(1e-9));
}

TEST(BurgersWave, RefusesWhatCannotBe) {
  EXPECT_THROW(BurgersWave(sine(-1)), std::invalid_argument);
  BurgersProblem problem = sine();
  problem.upper = 0;
  EXPECT_THROW(BurgersWave{problem}, std::invalid_argument);
  problem = sine();
  problem.velocity = [](double x) { return 1 / (x - x); };
  EXPECT_THROW(BurgersWave{problem}, std::invalid_argument);
}

}  // namespace tushar::burgers
