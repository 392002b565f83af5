#include "components/reference/riemann_solution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/reference/riemann_problems.hpp"

namespace tushar::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RiemannSolution solve(const RiemannProblem& problem) {
  return solveRiemann(problem.left, problem.right, problem.gas.gamma);
}

std::vector<RiemannSolution> allSolutions() {
  std::vector<RiemannSolution> all;
  for (const KnownTube& known : knownTubes()) all.push_back(solve(known.problem));
  for (const RiemannProblem& problem : hardTubes()) all.push_back(solve(problem));
  return all;
}

double totalEnergy(const RiemannState& s, double gamma) {
  return s.pressure / (gamma - 1) + 0.5 * s.density * s.velocity * s.velocity;
}

/// Expects continuous mass, momentum and energy fluxes in the frame of the shock, relative to the flux.
void expectRankineHugoniot(const RiemannState& ahead, const RiemannState& behind, double speed, double gamma) {
  const double u0 = ahead.velocity - speed;
  const double u1 = behind.velocity - speed;
  const double flux = ahead.density * u0;
  EXPECT_NEAR(behind.density * u1 / flux, 1, 1e-10);
  EXPECT_NEAR((behind.pressure + behind.density * u1 * u1) / (ahead.pressure + flux * u0), 1, 1e-10);
  const auto enthalpy = [&](const RiemannState& s) { return gamma / (gamma - 1) * s.pressure / s.density; };
  EXPECT_NEAR((enthalpy(behind) + u1 * u1 / 2) / (enthalpy(ahead) + u0 * u0 / 2), 1, 1e-10);
}

void expectSameState(const RiemannState& a, const RiemannState& b, double tolerance) {
  EXPECT_NEAR(a.density, b.density, tolerance * (1e-300 + b.density));
  EXPECT_NEAR(a.velocity, b.velocity, tolerance * (1 + std::abs(b.velocity)));
  EXPECT_NEAR(a.pressure, b.pressure, tolerance * (1e-300 + b.pressure));
}

TEST(RiemannSolution, HasThePublishedStarStates) {
  for (const KnownTube& known : knownTubes()) {
    SCOPED_TRACE(known.name);
    const RiemannSolution s = solve(known.problem);
    // As many digits as the table has.
    EXPECT_NEAR(s.starPressure / known.starPressure, 1, 1e-7);
    EXPECT_NEAR(s.starVelocity, known.starVelocity, 1e-7 * std::max(1.0, std::abs(known.starVelocity)));
    EXPECT_NEAR(s.starDensityLeft / known.starDensityLeft, 1, 1e-7);
    EXPECT_NEAR(s.starDensityRight / known.starDensityRight, 1, 1e-7);
  }
}

TEST(RiemannSolution, HasTheWaveSpeedsOfSod) {
  const RiemannSolution s = solve(sodTube());
  EXPECT_EQ(s.leftWave.kind, WaveKind::rarefaction);
  EXPECT_EQ(s.rightWave.kind, WaveKind::shock);
  EXPECT_NEAR(s.leftWave.head, -1.18321596, 1e-8);
  EXPECT_NEAR(s.leftWave.tail, -0.07027281, 1e-8);
  EXPECT_NEAR(s.starVelocity, 0.92745262, 1e-8);
  EXPECT_NEAR(s.rightWave.head, 1.75215573, 1e-8);
  EXPECT_EQ(s.rightWave.head, s.rightWave.tail);
}

TEST(RiemannSolution, MeetsRankineHugoniotAcrossEveryShock) {
  int shocks = 0;
  for (const RiemannSolution& s : allSolutions()) {
    const RiemannState left{s.starDensityLeft, s.starVelocity, s.starPressure};
    const RiemannState right{s.starDensityRight, s.starVelocity, s.starPressure};
    if (s.leftWave.kind == WaveKind::shock)
      expectRankineHugoniot(s.left, left, s.leftWave.head, s.leftGas.gamma), ++shocks;
    if (s.rightWave.kind == WaveKind::shock)
      expectRankineHugoniot(s.right, right, s.rightWave.head, s.leftGas.gamma), ++shocks;
  }
  EXPECT_GE(shocks, 15);
}

TEST(RiemannSolution, KeepsRiemannInvariantAndEntropyInEveryFan) {
  int fans = 0;
  for (const RiemannSolution& s : allSolutions()) {
    for (const bool onLeft : {true, false}) {
      const RiemannWave& wave = onLeft ? s.leftWave : s.rightWave;
      const RiemannState& side = onLeft ? s.left : s.right;
      if (wave.kind == WaveKind::shock || side.pressure == 0) continue;
      ++fans;
      const double sign = onLeft ? 1 : -1;
      const auto sound = [&](const RiemannState& q) { return std::sqrt(s.leftGas.gamma * q.pressure / q.density); };
      const auto invariant = [&](const RiemannState& q) {
        return q.velocity + sign * 2 * sound(q) / (s.leftGas.gamma - 1);
      };
      for (const double part : {0.1, 0.5, 0.9}) {
        const double xi = wave.head + part * (wave.tail - wave.head);
        const RiemannState q = s.sample(xi);
        const double size = sound(side) / (s.leftGas.gamma - 1) + std::abs(side.velocity);
        EXPECT_NEAR(invariant(q), invariant(side), 1e-12 * size);
        EXPECT_NEAR(q.velocity - sign * sound(q), xi, 1e-12 * size);
        EXPECT_NEAR(q.pressure / side.pressure, std::pow(q.density / side.density, s.leftGas.gamma), 1e-11);
      }
    }
  }
  EXPECT_GE(fans, 12);
}

TEST(RiemannSolution, IsContinuousAtTheEdgesOfEveryFan) {
  for (const KnownTube& known : knownTubes()) {
    const RiemannSolution s = solve(known.problem);
    if (s.leftWave.kind == WaveKind::shock) continue;
    SCOPED_TRACE(known.name);
    expectSameState(s.sample(s.leftWave.head * (1 + 1e-13)), s.sample(s.leftWave.head * (1 - 1e-13)), 1e-11);
    expectSameState(s.sample(s.leftWave.tail - 1e-13), s.sample(s.leftWave.tail + 1e-13), 1e-10);
  }
}

TEST(RiemannSolution, OrdersItsWaves) {
  for (const RiemannSolution& s : allSolutions()) {
    EXPECT_LE(s.leftWave.head, s.leftWave.tail);
    EXPECT_LE(s.leftWave.tail, s.starVelocity);
    EXPECT_LE(s.starVelocity, s.rightWave.tail);
    EXPECT_LE(s.rightWave.tail, s.rightWave.head);
  }
}

TEST(RiemannSolution, IsItsOwnMirrorImage) {
  for (const RiemannSolution& s : allSolutions()) {
    const auto flip = [](const RiemannState& q) { return RiemannState{q.density, -q.velocity, q.pressure}; };
    const RiemannSolution m = solveRiemann(flip(s.right), flip(s.left), s.leftGas.gamma);
    EXPECT_NEAR(m.starPressure, s.starPressure, 1e-13 * s.starPressure);
    for (int k = 0; k <= 20; ++k) {
      const double xi = s.leftWave.head + (s.rightWave.head - s.leftWave.head) * (k + 0.123) / 20;
      expectSameState(flip(m.sample(-xi)), s.sample(xi), 1e-12);
    }
  }
}

TEST(RiemannSolution, DoesNotDependOnTheObserver) {
  for (const KnownTube& known : knownTubes()) {
    SCOPED_TRACE(known.name);
    const double speed = 3.25;
    const RiemannSolution s = solve(known.problem);
    RiemannProblem moved = known.problem;
    moved.left.velocity += speed;
    moved.right.velocity += speed;
    const RiemannSolution m = solve(moved);
    for (int k = 0; k <= 20; ++k) {
      const double xi = s.leftWave.head + (s.rightWave.head - s.leftWave.head) * (k + 0.123) / 20;
      RiemannState expected = s.sample(xi);
      expected.velocity += speed;
      expectSameState(m.sample(xi + speed), expected, 1e-9);
    }
  }
}

TEST(RiemannSolution, OfEqualStatesIsThatState) {
  const RiemannState state{1.3, -0.7, 2.1};
  const RiemannSolution s = solveRiemann(state, state, 1.4);
  EXPECT_EQ(s.starPressure, state.pressure);
  EXPECT_EQ(s.starVelocity, state.velocity);
  for (const double xi : {-5.0, -2.0, -0.7, 0.0, 0.8, 5.0}) expectSameState(s.sample(xi), state, 1e-15);
}

TEST(RiemannSolution, OfOpposedStatesIsSymmetric) {
  const RiemannSolution s = solveRiemann({1, 3, 1}, {1, -3, 1}, 1.4);
  EXPECT_EQ(s.starVelocity, 0);
  EXPECT_EQ(s.starDensityLeft, s.starDensityRight);
  EXPECT_EQ(s.leftWave.head, -s.rightWave.head);
}

TEST(RiemannSolution, SendsAContactAloneWherePressureAndVelocityAgree) {
  const RiemannSolution s = solveRiemann({1, 2, 1}, {5, 2, 1}, 1.4);
  EXPECT_EQ(s.starPressure, 1);
  expectSameState(s.sample(1.999), {1, 2, 1}, 1e-15);
  expectSameState(s.sample(2.001), {5, 2, 1}, 1e-15);
}

TEST(RiemannSolution, IsNohWhereColdGasMeetsItself) {
  const double gamma = 5.0 / 3.0;
  const RiemannSolution s = solveRiemann({1, 1, 0}, {1, -1, 0}, gamma);
  EXPECT_NEAR(s.starPressure, 4.0 / 3.0, 1e-14);
  EXPECT_NEAR(s.starDensityLeft, 4, 1e-13);
  EXPECT_NEAR(s.rightWave.head, 1.0 / 3.0, 1e-14);
  EXPECT_EQ(s.starVelocity, 0);
}

TEST(RiemannSolution, ReachesTheLimitOfAColdRightSide) {
  const RiemannSolution cold = solveRiemann({1, 0, 1}, {1, 0, 0}, 1.4);
  const RiemannSolution nearly = solveRiemann({1, 0, 1}, {1, 0, 1e-13}, 1.4);
  EXPECT_NEAR(cold.starPressure, nearly.starPressure, 1e-11);
  EXPECT_NEAR(cold.starDensityRight, 6, 1e-12);  // (gamma + 1)/(gamma - 1)
}

TEST(RiemannSolution, LeavesVacuumBetweenGasesThatPartFastEnough) {
  const RiemannSolution s = solveRiemann({1, -10, 1}, {1, 10, 1}, 1.4);
  const double front = -10 + 5 * std::sqrt(1.4);
  EXPECT_TRUE(s.hasVacuum());
  EXPECT_EQ(s.starPressure, 0);
  EXPECT_NEAR(s.leftWave.tail, front, 1e-14);
  EXPECT_NEAR(s.rightWave.tail, -front, 1e-14);
  EXPECT_EQ(s.sample(-0.1).density, 0);
  EXPECT_EQ(s.sample(-0.1).velocity, s.leftWave.tail);
  EXPECT_EQ(s.sample(0.1).velocity, s.rightWave.tail);
  EXPECT_GT(s.sample(front - 0.5).density, 0);
}

TEST(RiemannSolution, JoinsVacuumContinuously) {
  const double limit = 5 * std::sqrt(1.4);  // each side's speed at which vacuum opens
  const RiemannSolution before = solveRiemann({1, -limit * (1 - 1e-9), 1}, {1, limit * (1 - 1e-9), 1}, 1.4);
  const RiemannSolution after = solveRiemann({1, -limit * (1 + 1e-9), 1}, {1, limit * (1 + 1e-9), 1}, 1.4);
  EXPECT_FALSE(before.hasVacuum());
  EXPECT_TRUE(after.hasVacuum());
  EXPECT_LT(before.starPressure, 1e-50);
  EXPECT_NEAR(before.sample(-3).density, after.sample(-3).density, 1e-8);
}

TEST(RiemannSolution, ExpandsIntoVacuumOnTheRight) {
  const RiemannSolution s = solveRiemann({1, 0, 1}, {0, 0, 0}, 1.4);
  EXPECT_NEAR(s.leftWave.tail, 5 * std::sqrt(1.4), 1e-14);
  EXPECT_EQ(s.starVelocity, s.leftWave.tail);
  const RiemannState sonic = s.sample(0);  // c = 2 c0/(gamma + 1) where u = c
  EXPECT_NEAR(sonic.velocity, std::sqrt(1.4) / 1.2, 1e-14);
  EXPECT_NEAR(sonic.density, std::pow(1 / 1.2, 5), 1e-14);
  for (const double xi : {6.0, 100.0, kInfinity}) {
    EXPECT_EQ(s.sample(xi).density, 0);
    EXPECT_EQ(s.sample(xi).pressure, 0);
    EXPECT_EQ(s.sample(xi).velocity, s.leftWave.tail);
  }
}

TEST(RiemannSolution, ExpandsIntoVacuumOnTheLeft) {
  const RiemannSolution right = solveRiemann({1, 0.5, 1}, {0, 0, 0}, 1.4);
  const RiemannSolution left = solveRiemann({0, 0, 0}, {1, -0.5, 1}, 1.4);
  for (const double xi : {-2.0, -0.5, 0.0, 3.0, 6.0, 7.0}) {
    const RiemannState a = right.sample(xi);
    const RiemannState b = left.sample(-xi);
    EXPECT_EQ(a.density, b.density);
    EXPECT_EQ(a.velocity, -b.velocity);
    EXPECT_EQ(a.pressure, b.pressure);
  }
}

TEST(RiemannSolution, LeavesColdGasThatPartsAlone) {
  const RiemannSolution s = solveRiemann({1, -1, 0}, {2, 1, 0}, 1.4);
  expectSameState(s.sample(-1.01), {1, -1, 0}, 0);
  expectSameState(s.sample(1.01), {2, 1, 0}, 0);
  EXPECT_EQ(s.sample(0.5).density, 0);
}

TEST(RiemannSolution, SolvesLeBlanc) {
  const RiemannSolution s = solve(leblancTube());
  // Strong shock: density x (gamma + 1)/(gamma - 1) = 4, speed 4/3 u*.
  EXPECT_NEAR(s.rightWave.head, 0.829, 5e-4);
  EXPECT_NEAR(s.starDensityRight, 4e-3, 1e-8);
  EXPECT_NEAR(s.starVelocity, 0.62184, 5e-5);
}

TEST(RiemannSolution, BalancesBothSidesAtEveryRatioUpTo1e10) {
  for (const double ratio : {1e2, 1e4, 1e6, 1e8, 1e10}) {
    for (const double densityRatio : {1 / ratio, 1.0, ratio}) {
      const RiemannSolution s = solveRiemann({densityRatio, 0, ratio}, {1, 0, 1}, 1.4);
      SCOPED_TRACE(testing::Message() << ratio << " " << densityRatio);
      // The velocity behind the shock, from its jump; that of the fan's tail, from the fan.
      const double massFlux = s.right.density * s.rightWave.head;
      EXPECT_NEAR((s.starPressure - 1) / massFlux / s.starVelocity, 1, 1e-11);  // p* - 1 cancels where p* is near 1
      const RiemannState tail = s.sample(s.leftWave.tail * (1 + (s.leftWave.tail < 0 ? 1e-15 : -1e-15)));
      EXPECT_NEAR(tail.velocity, s.starVelocity, 1e-12 * (s.starVelocity - s.leftWave.head));
    }
  }
}

TEST(RiemannSolution, ConservesMassMomentumAndEnergy) {
  for (const KnownTube& known : knownTubes()) {
    SCOPED_TRACE(known.name);
    const RiemannSolution s = solve(known.problem);
    const double a = s.leftWave.head - 1;
    const double b = s.rightWave.head + 1;
    // Over [a t, b t]: integral of q / t = b q_R - a q_L - (F_R - F_L).
    const auto expectBalance = [&](auto density, auto flux) {
      double sum = 0;
      const double edges[] = {a, s.leftWave.head, s.leftWave.tail, s.starVelocity, s.rightWave.tail, s.rightWave.head,
                              b};
      double size = 0;
      for (int k = 0; k < 6; ++k) {
        const auto q = [&](double xi) { return density(s.sample(xi)); };
        sum += (edges[k + 1] - edges[k]) * midpointMean(q, edges[k], edges[k + 1], 4000);
        size += std::abs(q(0.5 * (edges[k] + edges[k + 1]))) * (edges[k + 1] - edges[k]);
      }
      const double expected = b * density(s.right) - a * density(s.left) - (flux(s.right) - flux(s.left));
      EXPECT_NEAR(sum, expected, 1e-6 * size);  // midpoint rule with 4000 points in a fan
    };
    const auto mass = [](const RiemannState& q) { return q.density; };
    const auto momentum = [](const RiemannState& q) { return q.density * q.velocity; };
    const auto energy = [&](const RiemannState& q) { return totalEnergy(q, s.leftGas.gamma); };
    expectBalance(mass, momentum);
    expectBalance(momentum, [](const RiemannState& q) { return q.density * q.velocity * q.velocity + q.pressure; });
    expectBalance(energy, [&](const RiemannState& q) { return (energy(q) + q.pressure) * q.velocity; });
  }
}

TEST(RiemannSolution, RefusesStatesThatCannotBe) {
  const RiemannState fine{1, 0, 1};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(solveRiemann(fine, fine, 1.0), std::invalid_argument);
  EXPECT_THROW(solveRiemann(fine, fine, nan), std::invalid_argument);
  EXPECT_THROW(solveRiemann({-1, 0, 1}, fine, 1.4), std::invalid_argument);
  EXPECT_THROW(solveRiemann(fine, {1, 0, -1}, 1.4), std::invalid_argument);
  EXPECT_THROW(solveRiemann(fine, {1, nan, 1}, 1.4), std::invalid_argument);
  EXPECT_THROW(solveRiemann({kInfinity, 0, 1}, fine, 1.4), std::invalid_argument);
  EXPECT_THROW(solveRiemann({0, 0, 1}, fine, 1.4), std::invalid_argument);
  EXPECT_THROW(solveRiemann({0, 0, 0}, {0, 0, 0}, 1.4), std::invalid_argument);
}

TEST(RiemannSolution, NamesTheSideAndTheValueItRefuses) {
  try {
    solveRiemann({1, 0, 1}, {.125, 0, -3}, 1.4);
    FAIL() << "a negative pressure was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "The right side of the Riemann problem (density 0.125, velocity 0, pressure -3) has a negative pressure.");
  }
}

}  // namespace
}  // namespace tushar::reference
