#include "components/reference/isentropic_vortex.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/reference/gas_equations.hpp"

namespace tushar::reference {
namespace {

/// Shu's vortex in a box of 10 m.
IsentropicVortexProblem shu() {
  IsentropicVortexProblem problem;
  problem.frame = {Vec3::Zero(), Vec3(1, 1, 0), Vec3(10, 10, 0)};
  return problem;
}

TEST(IsentropicVortex, HasShusValuesAtItsStart) {
  const IsentropicVortex vortex(shu());
  const double r = std::hypot(0.3, 0.8), f = 5 / (2 * M_PI) * std::exp((1 - r * r) / 2);
  const double temperature = 1 - 0.4 * 25 / (8 * 1.4 * M_PI * M_PI) * std::exp(1 - r * r);
  const GasState gas = vortex.at(Vec3(0.3, 0.8, 7), 0);
  EXPECT_NEAR(gas.density, std::pow(temperature, 2.5), 1e-15);
  EXPECT_NEAR(gas.pressure, std::pow(temperature, 3.5), 1e-15);
  EXPECT_NEAR(gas.energy, temperature / 0.4, 1e-15);
  EXPECT_NEAR((gas.velocity - Vec3(1 - 0.8 * f, 1 + 0.3 * f, 0)).norm(), 0, 1e-15);
}

TEST(IsentropicVortex, SolvesTheGasEquationsInAnyUnits) {
  IsentropicVortexProblem problem = shu();
  problem.density = 2;
  problem.pressure = 3;
  problem.gamma = 5.0 / 3;
  problem.radius = 0.5;
  problem.frame.velocity = Vec3(0.7, -0.4, 0);
  for (const IsentropicVortexProblem& p : {shu(), problem}) {
    const IsentropicVortex vortex(p);
    // Differences of fourth order: d^4 times fifth derivatives of about 1e3.
    for (const Vec3& x : {Vec3(0.1, 0.2, 0), Vec3(1, -0.5, 0), Vec3(-0.3, 0.9, 0)})
      EXPECT_LT(gasResidual(vortex, x, 0.2, p.gamma, 2e-3), 1e-7);
  }
}

TEST(IsentropicVortex, IsCarriedAlongAndComesBack) {
  const IsentropicVortex vortex(shu());
  const Vec3 x(0.4, -0.2, 0);
  EXPECT_LT(difference(vortex.at(x + Vec3(1.5, 1.5, 0), 1.5), vortex.at(x, 0)), 1e-14);
  EXPECT_LT(difference(vortex.at(x, 10), vortex.at(x, 0)), 1e-13);
  EXPECT_LT(difference(vortex.at(x + Vec3(10, -20, 0), 0), vortex.at(x, 0)), 1e-13);
}

TEST(IsentropicVortex, IsFarAwayWhereTheGridDoesNotRepeat) {
  IsentropicVortexProblem problem = shu();
  problem.frame.periods = Vec3::Zero();
  EXPECT_DOUBLE_EQ(IsentropicVortex(problem).at(Vec3(10, 10, 0), 0).density, 1);
}

TEST(IsentropicVortex, TurnsAlikeAroundEveryAxis) {
  IsentropicVortexProblem problem = shu();
  const GasState z = IsentropicVortex(problem).at(Vec3(0.3, 0.8, 0), 0.2);
  for (int axis = 0; axis < 2; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const auto turned = [&](double alongA, double alongB) -> Vec3 {
      return alongA * Vec3::Unit(a) + alongB * Vec3::Unit(b);
    };
    problem.axis = axis;
    problem.frame = {Vec3::Zero(), turned(1, 1), turned(10, 10)};
    const GasState gas = IsentropicVortex(problem).at(turned(0.3, 0.8), 0.2);
    EXPECT_EQ(gas.density, z.density);
    EXPECT_EQ(gas.velocity, turned(z.velocity[0], z.velocity[1]));
  }
}

TEST(IsentropicVortex, AveragesToTwelveDigits) {
  const IsentropicVortex vortex(shu());
  for (const Vec3& lower : {Vec3(0, 0, 0), Vec3(-1, 0.5, 0), Vec3(-2, -2.3, 0)}) {
    const Vec3 upper = lower + Vec3(0.33, 0.33, 0);
    // Compared with the adaptive rule of all references, which is accurate to 1e-12.
    EXPECT_LT(difference(vortex.average(lower, upper, 0.1), vortex.GasReference::average(lower, upper, 0.1)), 2e-12);
  }
}

TEST(IsentropicVortex, AveragesAcrossTheSeamBetweenImages) {
  IsentropicVortexProblem problem = shu();
  problem.frame.periods = Vec3(3, 3, 0);  // so short that the slopes jump at the seam
  const IsentropicVortex vortex(problem);
  const Vec3 lower(1.4, -0.4, 0), upper(1.9, 0.1, 0);
  const auto half = [&](double from, double to) -> Fields {
    return toFields(vortex.average(Vec3(from, -0.4, 0), Vec3(to, 0.1, 0), 0)) * (to - from);
  };
  EXPECT_LT((toFields(vortex.average(lower, upper, 0)) * 0.5 - half(1.4, 1.5) - half(1.5, 1.9)).abs().maxCoeff(),
            1e-11);
}

TEST(IsentropicVortex, IsTheSameAllAlongItsAxis) {
  const IsentropicVortex vortex(shu());
  const GasState flat = vortex.average(Vec3(0, 0, 0), Vec3(0.3, 0.3, 0), 0.1);
  EXPECT_EQ(difference(vortex.average(Vec3(0, 0, -2), Vec3(0.3, 0.3, 5), 0.1), flat), 0);
}

TEST(IsentropicVortex, RefusesWhatCannotBe) {
  const auto expectRefused = [](auto change) {
    IsentropicVortexProblem problem = shu();
    change(problem);
    EXPECT_THROW(IsentropicVortex{problem}, std::invalid_argument);
  };
  expectRefused([](auto& p) { p.density = 0; });
  expectRefused([](auto& p) { p.pressure = -1; });
  expectRefused([](auto& p) { p.gamma = 1; });
  expectRefused([](auto& p) { p.radius = 0; });
  expectRefused([](auto& p) { p.axis = 3; });
  expectRefused([](auto& p) { p.strength = 11; });  // beta²(gamma-1)e > 8 pi² gamma p / rho
  EXPECT_THROW(IsentropicVortex(shu()).average(Vec3(1, 0, 0), Vec3(0, 1, 0), 0), std::invalid_argument);
}

}  // namespace
}  // namespace tushar::reference
