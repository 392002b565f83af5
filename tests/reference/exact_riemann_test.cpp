#include "components/reference/exact_riemann.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/reference/riemann_problems.hpp"

namespace tushar::reference {
namespace {

Vec3 along(int axis, double x) {
  Vec3 point = Vec3::Zero();
  point[axis] = x;
  return point;
}

/// Returns the mean by 20000 midpoints in each interval between breaks.
double bruteMean(const GasReference& gas, double a, double b, double t, double (*field)(const GasState&)) {
  std::vector<double> edges{a};
  for (double x : gas.breaks(0, t)) {
    if (x > a && x < b) edges.push_back(x);
  }
  edges.push_back(b);
  double sum = 0;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    const auto f = [&](double x) { return field(gas.at(Vec3(x, 0, 0), t)); };
    sum += (edges[k + 1] - edges[k]) * midpointMean(f, edges[k], edges[k + 1], 20000);
  }
  return sum / (b - a);
}

TEST(ExactRiemann, StartsAsTwoUniformStates) {
  const ExactRiemann sod(sodTube());
  EXPECT_EQ(sod.at(Vec3(0.499, 0, 0), 0).density, 1);
  EXPECT_EQ(sod.at(Vec3(0.501, 0, 0), 0).density, 0.125);
  EXPECT_DOUBLE_EQ(sod.at(Vec3(0.501, 0, 0), 0).energy, 2.0);
  EXPECT_DOUBLE_EQ(sod.average(Vec3(0.4, 0, 0), Vec3(0.6, 0, 0), 0).density, 0.5625);
}

TEST(ExactRiemann, OfAStiffenedGasKeepsMassMomentumAndEnergyAcrossItsShock) {
  RiemannProblem water = tube({1000, 0, 1e10}, {1000, 0, 1e5}, 0.5);
  water.gas.gamma = 4.4;
  water.gas.stiffness = 6e8;
  const ExactRiemann exact(water);
  const double t = 1e-5, speed = exact.solution().rightWave.head;
  const GasState ahead = exact.at(Vec3(0.5 + 1.01 * speed * t, 0, 0), t);
  const GasState behind = exact.at(Vec3(0.5 + 0.99 * speed * t, 0, 0), t);
  const auto massFlux = [&](const GasState& gas) { return gas.density * (gas.velocity[0] - speed); };
  const auto momentumFlux = [&](const GasState& gas) {
    return gas.pressure + massFlux(gas) * (gas.velocity[0] - speed);
  };
  const auto totalEnthalpy = [&](const GasState& gas) {
    return gas.energy + gas.pressure / gas.density + 0.5 * std::pow(gas.velocity[0] - speed, 2);
  };

  EXPECT_GT(behind.pressure, 1e9);
  EXPECT_DOUBLE_EQ(ahead.pressure, 1e5);
  EXPECT_DOUBLE_EQ(ahead.energy, (1e5 + 4.4 * 6e8) / (3.4 * 1000));
  // Rankine & Hugoniot; the solver is exact to 1e-14, and differences of such fluxes lose two digits.
  EXPECT_NEAR(massFlux(behind) / massFlux(ahead), 1, 1e-12);
  EXPECT_NEAR(momentumFlux(behind) / momentumFlux(ahead), 1, 1e-12);
  EXPECT_NEAR(totalEnthalpy(behind) / totalEnthalpy(ahead), 1, 1e-12);
}

/// Water at 1e9 Pa next to air: R. Saurel & R. Abgrall, J. Comput. Phys. 150 (1999) 425.
RiemannProblem waterBesideAir() {
  RiemannProblem problem = tube({1000, 0, 1e9}, {50, 0, 1e5}, 0.7);
  problem.gas = {4.4, 6e8};
  problem.rightGas = GasLaw{1.4, 0};
  return problem;
}

TEST(ExactRiemann, OfTwoGasesHasOnePressureAndVelocityAtTheirContact) {
  const ExactRiemann exact(waterBesideAir());
  const double contact = 0.7 + 2e-4 * exact.solution().starVelocity;

  const GasState water = exact.at(Vec3(contact - 1e-9, 0, 0), 2e-4), air = exact.at(Vec3(contact + 1e-9, 0, 0), 2e-4);

  EXPECT_GT(water.density, 2 * air.density);
  EXPECT_NEAR(water.pressure / air.pressure, 1, 1e-9);  // the solver is exact to 1e-14 of p + p_inf, here 40 times p
  EXPECT_NEAR(water.velocity[0] / air.velocity[0], 1, 1e-12);
  EXPECT_NEAR(water.energy, (water.pressure + 4.4 * 6e8) / (3.4 * water.density), 1e-9 * water.energy);
  EXPECT_NEAR(air.energy, air.pressure / (0.4 * air.density), 1e-9 * air.energy);
}

TEST(ExactRiemann, OfTwoGasesKeepsEntropyInTheFanAndFluxesAcrossTheShock) {
  const ExactRiemann exact(waterBesideAir());
  const RiemannSolution& s = exact.solution();
  const GasState water = exact.at(Vec3(0.7 + 1e-4 * s.leftWave.tail, 0, 0), 1e-4);
  const GasState shocked = exact.at(Vec3(0.7 + 1e-4 * s.rightWave.head * 0.999, 0, 0), 1e-4);
  const double ahead = 50 * (0 - s.rightWave.head), behind = shocked.density * (shocked.velocity[0] - s.rightWave.head);

  EXPECT_EQ(s.leftWave.kind, WaveKind::rarefaction);
  EXPECT_EQ(s.rightWave.kind, WaveKind::shock);
  EXPECT_NEAR((water.pressure + 6e8) / 1.6e9, std::pow(water.density / 1000, 4.4), 1e-11);
  EXPECT_NEAR(behind / ahead, 1, 1e-12);
  EXPECT_NEAR((shocked.pressure - 1e5) / (-ahead * shocked.velocity[0]), 1, 1e-12);
}

TEST(ExactRiemann, OfTwoGasesIsItsOwnMirrorImage) {
  RiemannProblem mirrored = waterBesideAir();
  std::swap(mirrored.left, mirrored.right);
  mirrored.rightGas = std::exchange(mirrored.gas, *mirrored.rightGas);
  const ExactRiemann one(waterBesideAir()), other(mirrored);
  for (const double x : {-0.5, -0.3, -0.1, 0.05, 0.12, 0.15}) {
    const GasState a = one.at(Vec3(0.7 + x, 0, 0), 2e-4), b = other.at(Vec3(0.7 - x, 0, 0), 2e-4);
    EXPECT_NEAR(a.density / b.density, 1, 1e-12) << x;
    EXPECT_NEAR(a.velocity[0] + b.velocity[0], 0, 1e-9) << x;
  }
}

TEST(ExactRiemann, RefusesTwoGasesThatPart) {
  RiemannProblem problem = waterBesideAir();
  problem.left.velocity = -1e4;
  problem.right.velocity = 1e4;
  EXPECT_THROW(ExactRiemann{problem}, std::invalid_argument);
}

TEST(ExactRiemann, IsSelfSimilar) {
  const ExactRiemann sod(sodTube());
  for (const double xi : {-1.5, -1.0, 0.0, 0.5, 1.2, 1.9}) {
    EXPECT_NEAR(sod.at(Vec3(0.5 + 0.1 * xi, 0, 0), 0.1).density, sod.at(Vec3(0.5 + 0.2 * xi, 0, 0), 0.2).density,
                1e-14);
  }
}

TEST(ExactRiemann, BreaksWhereItsWavesAre) {
  const std::vector<double> breaks = ExactRiemann(sodTube()).breaks(0, 0.2);
  ASSERT_EQ(breaks.size(), 4u);
  EXPECT_NEAR(breaks[0], 0.5 - 0.2 * 1.18321596, 1e-8);
  EXPECT_NEAR(breaks[1], 0.5 - 0.2 * 0.07027281, 1e-8);
  EXPECT_NEAR(breaks[2], 0.5 + 0.2 * 0.92745262, 1e-8);
  EXPECT_NEAR(breaks[3], 0.5 + 0.2 * 1.75215573, 1e-8);
}

TEST(ExactRiemann, HasNoBreaksAcrossItsAxis) { EXPECT_TRUE(ExactRiemann(sodTube()).breaks(1, 0.2).empty()); }

TEST(ExactRiemann, AveragesSodAsBruteForceDoes) {
  const ExactRiemann sod(sodTube());
  for (const auto& [a, b] : {std::pair{0.0, 1.0}, {0.26, 0.27}, {0.30, 0.31}, {0.2, 0.5}, {0.68, 0.69}, {0.85, 0.86}}) {
    const GasState mean = sod.average(Vec3(a, 0, 0), Vec3(b, 0, 0), 0.2);
    // The reference is a midpoint rule: 1e-10 is its error, not that of the average.
    EXPECT_NEAR(mean.density, bruteMean(sod, a, b, 0.2, [](const GasState& g) { return g.density; }), 2e-10);
    EXPECT_NEAR(mean.velocity[0], bruteMean(sod, a, b, 0.2, [](const GasState& g) { return g.velocity[0]; }), 2e-10);
    EXPECT_NEAR(mean.pressure, bruteMean(sod, a, b, 0.2, [](const GasState& g) { return g.pressure; }), 2e-10);
    EXPECT_NEAR(mean.energy, bruteMean(sod, a, b, 0.2, [](const GasState& g) { return g.energy; }), 2e-10);
  }
}

TEST(ExactRiemann, AveragesHardTubesAsBruteForceDoes) {
  for (const RiemannProblem& problem : hardTubes()) {
    const ExactRiemann gas(problem);
    const double t = 0.2 / std::max(gas.solution().rightWave.head, -gas.solution().leftWave.head);
    const GasState mean = gas.average(Vec3(0.25, 0, 0), Vec3(0.75, 0, 0), t);
    const double density = bruteMean(gas, 0.25, 0.75, t, [](const GasState& g) { return g.density; });
    EXPECT_NEAR(mean.density / density, 1, 1e-7);
  }
}

TEST(ExactRiemann, AveragesSodExactlyInEachPartOfAFan) {
  // rho is a quintic of x in a fan of gamma = 1.4, so its mean is known: rho (c/c0)^5, c linear.
  const ExactRiemann sod(sodTube());
  const auto antiderivative = [&](double x) {
    const double c0 = std::sqrt(1.4);
    const double y = (1 - 0.2 * (x - 0.5) / 0.2 / c0) / 1.2;
    return -std::pow(y, 6) / 6 * 1.2 * c0;  // dy/dx = -1/(1.2 c0) at t = .2
  };
  for (const auto& [a, b] : {std::pair{0.27, 0.48}, {0.3, 0.3001}, {0.4, 0.41}}) {
    const double exact = (antiderivative(b) - antiderivative(a)) / (b - a);
    EXPECT_NEAR(sod.average(Vec3(a, 0, 0), Vec3(b, 0, 0), 0.2).density, exact, 1e-11);
  }
}

TEST(ExactRiemann, AveragesAddUp) {
  const ExactRiemann sod(sodTube());
  double sum = 0;
  for (int c = 0; c < 800; ++c) sum += sod.average(Vec3(c / 800.0, 0, 0), Vec3((c + 1) / 800.0, 0, 0), 0.2).density;
  EXPECT_NEAR(sum / 800, sod.average(Vec3(0, 0, 0), Vec3(1, 0, 0), 0.2).density, 1e-13);
  EXPECT_NEAR(sum / 800, 0.5625, 1e-13);  // no gas crosses the walls before the waves reach them
}

TEST(ExactRiemann, LosesAndGainsMassThroughTheBoxAlone) {
  const ExactRiemann moving(tube({1, .75, 1}, {.125, 0, .1}, .3));
  const Vec3 lower(-1, 0, 0);
  const Vec3 upper(2, 0, 0);
  for (const double t : {0.1, 0.2, 0.4}) {
    const double gained = 3 * (moving.average(lower, upper, t).density - moving.average(lower, upper, 0).density);
    EXPECT_NEAR(gained, 0.75 * t, 1e-12);  // rho u = .75 flows in on the left, nothing leaves
  }
}

TEST(ExactRiemann, LooksAlikeAlongEveryAxis) {
  RiemannProblem problem = sodTube();
  const ExactRiemann x(problem);
  for (int axis = 1; axis < 3; ++axis) {
    problem.axis = axis;
    const ExactRiemann other(problem);
    for (const double s : {0.1, 0.4, 0.6, 0.8, 0.9}) {
      EXPECT_EQ(other.at(along(axis, s), 0.2).density, x.at(along(0, s), 0.2).density);
      EXPECT_EQ(other.at(along(axis, s), 0.2).velocity[axis], x.at(along(0, s), 0.2).velocity[0]);
    }
    const GasState box = other.average(Vec3(0.3, 0.3, 0.3), Vec3(0.7, 0.7, 0.7), 0.2);
    EXPECT_EQ(box.density, x.average(Vec3(0.3, 0, 0), Vec3(0.7, 0, 0), 0.2).density);
  }
}

TEST(ExactRiemann, CarriesTransverseVelocitiesUpToTheContact) {
  RiemannProblem problem = sodTube();
  problem.leftTransverse = Vec3(99, 2, 3);
  problem.rightTransverse = Vec3(99, -4, 5);
  const ExactRiemann gas(problem);
  const double contact = 0.5 + 0.2 * gas.solution().starVelocity;
  EXPECT_EQ(gas.at(Vec3(contact - 1e-6, 0, 0), 0.2).velocity.tail<2>(), Vec<2>(2, 3));
  EXPECT_EQ(gas.at(Vec3(contact + 1e-6, 0, 0), 0.2).velocity.tail<2>(), Vec<2>(-4, 5));
  EXPECT_NEAR(gas.at(Vec3(contact + 1e-6, 0, 0), 0.2).velocity[0], 0.92745262, 1e-8);
}

TEST(ExactRiemann, HasNothingInVacuum) {
  const ExactRiemann gas(tube({1, 0, 1}, {0, 0, 0}));
  const GasState nothing = gas.at(Vec3(2, 0, 0), 0.1);
  EXPECT_EQ(nothing.density, 0);
  EXPECT_EQ(nothing.pressure, 0);
  EXPECT_EQ(nothing.energy, 0);
  EXPECT_EQ(nothing.velocity[0], gas.solution().leftWave.tail);
  EXPECT_NEAR(gas.average(Vec3(0, 0, 0), Vec3(2, 0, 0), 0.1).density, 0.25, 1e-13);  // all the gas, .5 of it
}

TEST(ExactRiemann, RefusesWhatCannotBe) {
  RiemannProblem problem = sodTube();
  problem.axis = 3;
  EXPECT_THROW(ExactRiemann{problem}, std::invalid_argument);
  const ExactRiemann sod(sodTube());
  EXPECT_THROW(sod.at(Vec3::Zero(), -1), std::invalid_argument);
  EXPECT_THROW(sod.average(Vec3(1, 0, 0), Vec3(0, 0, 0), 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace tushar::reference
