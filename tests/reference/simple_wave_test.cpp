#include "components/reference/simple_wave.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tushar::reference {
namespace {

double bump(double x) { return 0.1 * std::exp(-std::pow((x - 0.3) / 0.07, 2)); }

SimpleWaveProblem bumpProblem() {
  SimpleWaveProblem problem;
  problem.velocity = bump;
  return problem;
}

TEST(SimpleWave, StartsWithItsProfile) {
  const SimpleWave wave(bumpProblem());
  for (const double x : {0.0, 0.2, 0.3, 0.37, 1.0}) {
    const GasState gas = wave.at(Vec3(x, 0, 0), 0);
    EXPECT_DOUBLE_EQ(gas.velocity[0], bump(x));
    EXPECT_NEAR(gas.density, std::pow(1 + 0.2 * bump(x), 5), 1e-15);
  }
}

TEST(SimpleWave, RestsFarAway) {
  SimpleWaveProblem problem = bumpProblem();
  problem.density = 2;
  problem.soundSpeed = 3;
  const GasState gas = SimpleWave(problem).at(Vec3(50, 0, 0), 0.3);
  EXPECT_DOUBLE_EQ(gas.density, 2);
  EXPECT_DOUBLE_EQ(gas.pressure, 2 * 9 / 1.4);
  EXPECT_DOUBLE_EQ(gas.energy, 9 / (1.4 * 0.4));
  EXPECT_EQ(gas.velocity, Vec3::Zero());
}

TEST(SimpleWave, CarriesItsValuesAlongCharacteristics) {
  const SimpleWave wave(bumpProblem());
  for (int k = 0; k <= 100; ++k) {
    const double start = 0.01 * k;
    const double x = start + (1 + 1.2 * bump(start)) * 0.3;
    EXPECT_NEAR(wave.foot(x, 0.3), start, 1e-14);
    EXPECT_NEAR(wave.at(Vec3(x, 0, 0), 0.3).velocity[0], bump(start), 1e-14);
  }
}

TEST(SimpleWave, FollowsCharacteristicsCloseToBreaking) {
  const SimpleWave wave(bumpProblem());
  const double t = 0.9999 * wave.breakingTime();
  for (int k = 0; k <= 200; ++k) {
    const double start = 0.2 + 0.001 * k;
    EXPECT_NEAR(wave.foot(start + (1 + 1.2 * bump(start)) * t, t), start, 1e-11);
  }
}

TEST(SimpleWave, RefusesAVelocityThatMakesAPressureBeyondAllNumbers) {
  SimpleWaveProblem problem;
  problem.velocity = [](double) { return 1e308; };

  EXPECT_THROW(SimpleWave{problem}, std::invalid_argument);
}

TEST(SimpleWave, SolvesTheGasEquations) {
  const SimpleWave wave(bumpProblem());
  const double d = 1e-4;
  for (const double x : {0.45, 0.55, 0.6, 0.62, 0.65, 0.7}) {
    const auto gas = [&](double dx, double dt) { return wave.at(Vec3(x + dx, 0, 0), 0.3 + dt); };
    const auto slopes = [&](auto field) {
      return std::pair{(field(gas(0, d)) - field(gas(0, -d))) / (2 * d),
                       (field(gas(d, 0)) - field(gas(-d, 0))) / (2 * d)};
    };
    const GasState here = gas(0, 0);
    const double u = here.velocity[0];
    const auto [rhoT, rhoX] = slopes([](const GasState& g) { return g.density; });
    const auto [uT, uX] = slopes([](const GasState& g) { return g.velocity[0]; });
    const auto [pT, pX] = slopes([](const GasState& g) { return g.pressure; });
    const auto [eT, eX] = slopes([](const GasState& g) { return g.energy; });
    // d^2 times third derivatives of about 0.1/0.07^3, times the steepening of 1.6.
    EXPECT_NEAR(rhoT + u * rhoX + here.density * uX, 0, 2e-5);
    EXPECT_NEAR(uT + u * uX + pX / here.density, 0, 2e-5);
    EXPECT_NEAR(pT + u * pX + 1.4 * here.pressure * uX, 0, 2e-5);
    EXPECT_NEAR(eT + u * eX + here.pressure / here.density * uX, 0, 2e-5);
  }
}

TEST(SimpleWave, KeepsEntropyAndEquationOfState) {
  const SimpleWave wave(bumpProblem());
  for (const double x : {0.5, 0.6, 0.65}) {
    const GasState gas = wave.at(Vec3(x, 0, 0), 0.3);
    EXPECT_NEAR(gas.pressure, std::pow(gas.density, 1.4) / 1.4, 1e-14);
    EXPECT_NEAR(gas.pressure, 0.4 * gas.density * gas.energy, 1e-14);
  }
}

TEST(SimpleWave, KeepsItsMass) {
  const SimpleWave wave(bumpProblem());
  const Vec3 lower(-1, 0, 0);
  const Vec3 upper(2, 0, 0);
  EXPECT_NEAR(wave.average(lower, upper, 0.3).density, wave.average(lower, upper, 0).density, 1e-12);
}

TEST(SimpleWave, AveragesAsBruteForceDoes) {
  const SimpleWave wave(bumpProblem());
  for (const auto& [a, b] : {std::pair{0.6, 0.62}, {0.5, 0.7}, {0.0, 1.0}}) {
    GasState sum;
    const int n = 20000;
    for (int k = 0; k < n; ++k) {
      const GasState gas = wave.at(Vec3(a + (b - a) * (k + 0.5) / n, 0, 0), 0.3);
      sum.density += gas.density / n;
      sum.velocity += gas.velocity / n;
    }
    const GasState mean = wave.average(Vec3(a, 0, 0), Vec3(b, 0, 0), 0.3);
    EXPECT_NEAR(mean.density, sum.density, 1e-10);
    EXPECT_NEAR(mean.velocity[0], sum.velocity[0], 1e-10);
  }
}

TEST(SimpleWave, BreaksWhereItsProfileFallsFastest) {
  // min f' = -A sqrt(2/e)/w for a Gaussian of height A and width w.
  const double expected = 0.07 / (1.2 * 0.1 * std::sqrt(2 / std::exp(1.0)));
  EXPECT_NEAR(SimpleWave(bumpProblem()).breakingTime() / expected, 1, 1e-8);
}

TEST(SimpleWave, NeverBreaksWhereItsProfileDoesNotFall) {
  SimpleWaveProblem problem = bumpProblem();
  problem.velocity = [](double x) { return 0.1 * std::tanh(x); };
  EXPECT_EQ(SimpleWave(problem).breakingTime(), std::numeric_limits<double>::infinity());
  problem.velocity = [](double) { return 0.1; };
  EXPECT_EQ(SimpleWave(problem).breakingTime(), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(SimpleWave(problem).at(Vec3(1, 0, 0), 1e3).velocity[0], 0.1, 1e-15);
}

TEST(SimpleWave, RunsAlongItsAxis) {
  SimpleWaveProblem problem = bumpProblem();
  const SimpleWave x(problem);
  problem.axis = 2;
  const SimpleWave z(problem);
  EXPECT_EQ(z.at(Vec3(5, 5, 0.6), 0.3).velocity[2], x.at(Vec3(0.6, 0, 0), 0.3).velocity[0]);
  EXPECT_EQ(z.average(Vec3(0, 0, 0.6), Vec3(1, 1, 0.7), 0.3).density,
            x.average(Vec3(0.6, 0, 0), Vec3(0.7, 0, 0), 0.3).density);
}

TEST(SimpleWave, RefusesTimesAfterBreakingAndNamesTheTime) {
  const SimpleWave wave(bumpProblem());
  try {
    wave.at(Vec3(0.5, 0, 0), 1);
    FAIL() << "a broken wave was given a value";
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("breaks at t = 0.68"), std::string::npos) << error.what();
  }
  EXPECT_THROW(wave.at(Vec3(0.5, 0, 0), -1), std::invalid_argument);
}

TEST(SimpleWave, RefusesSettingsThatCannotBe) {
  const auto expectRefused = [](auto change) {
    SimpleWaveProblem problem = bumpProblem();
    change(problem);
    EXPECT_THROW(SimpleWave{problem}, std::invalid_argument);
  };
  expectRefused([](SimpleWaveProblem& p) { p.velocity = nullptr; });
  expectRefused([](SimpleWaveProblem& p) { p.gamma = 1; });
  expectRefused([](SimpleWaveProblem& p) { p.density = 0; });
  expectRefused([](SimpleWaveProblem& p) { p.soundSpeed = -1; });
  expectRefused([](SimpleWaveProblem& p) { p.upper = p.lower; });
  expectRefused([](SimpleWaveProblem& p) { p.axis = 3; });
  expectRefused([](SimpleWaveProblem& p) { p.velocity = [](double) { return -10.0; }; });
}

}  // namespace
}  // namespace tushar::reference
