#include "components/ice/start.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tushar::ice {
namespace {

TEST(CustomStart, AVortexTurnsTheGasWithinItsRadius) {
  const double rho = 2, strength = 10, radius = .5;
  CustomStart start;
  start.vortices = VortexList{{{0, {9, .1, .2}, strength, radius}}};
  Vec3 velocity(1, 2, 3);
  double temperature = 300;
  start.apply({-7, .1 + .3, .2 - .1}, {.density = rho}, velocity, temperature);
  const double turn = strength / (rho * radius * radius) * std::exp(-(.09 + .01) / (2 * .25));
  EXPECT_LT((velocity - Vec3(1, 2 + turn * .1, 3 + turn * .3)).norm(), 1e-12);
  EXPECT_EQ(temperature, 300);
  start.apply({0, .1 + .5001, .2}, {.density = rho}, velocity = Vec3(1, 2, 3), temperature);
  EXPECT_EQ(velocity, Vec3(1, 2, 3));
}

TEST(CustomStart, VorticesAddUp) {
  CustomStart start;
  start.vortices = VortexList{{{2, {0, 0, 0}, 10, .5}, {2, {0, 0, 0}, -10, .5}}};
  Vec3 velocity = Vec3::Zero();
  double temperature = 300;
  start.apply({.1, .2, 0}, {.density = 1}, velocity, temperature);
  EXPECT_LT(velocity.norm(), 1e-12);
}

TEST(CustomStart, ABellStandsOnTheTemperatureOf300K) {
  CustomStart start;
  start.temperature = GaussianTemperature{700, {.5, .5, 0}, .1, .2};
  Vec3 velocity = Vec3::Zero();
  double temperature = 1;
  start.apply({.5, .5, 4}, {.density = 1}, velocity, temperature);
  EXPECT_DOUBLE_EQ(temperature, 1000);
  start.apply({.6, .9, 4}, {.density = 1}, velocity, temperature);
  EXPECT_NEAR(temperature, 300 + 700 * std::exp(-.5 - 2), 1e-10);
  start.apply({100, 100, 4}, {.density = 1}, velocity, temperature);
  EXPECT_EQ(temperature, 300);
}

TEST(CustomStart, OfACounterflow) {
  CustomStart start;
  start.counterflow = Counterflow{2000};
  Vec3 velocity(7, 7, 7);
  double temperature = 300;
  start.apply({.001, .009, .5}, {.density = 1, .middle = Vec3(.005, .005, .005)}, velocity, temperature);
  EXPECT_LT((velocity - Vec3(8, 8, 7)).norm(), 1e-12);
}

TEST(CustomStart, OfVorticesInAWind) {
  CustomStart start;
  start.manufactured = Manufactured{.type = "mms_1", .amplitude = 2};
  Vec3 velocity = Vec3::Zero();
  double temperature = 300;
  const StartPlace place{.density = 1.2, .gas = {.gamma = 1.4, .specificHeat = 287 / .4}};
  start.apply({.3, .7, 0}, place, velocity, temperature);
  EXPECT_NEAR(velocity[0], 1 - 2 * std::cos(.3) * std::sin(.7), 1e-14);
  EXPECT_NEAR(velocity[1], 1 + 2 * std::sin(.3) * std::cos(.7), 1e-14);
  EXPECT_NEAR(temperature * 1.2 * 287, 101325 - (std::cos(.6) + std::cos(1.4)), 1e-9);
}

TEST(CustomStart, OfAWindHasItsPressureInAnyGas) {
  CustomStart start;
  start.manufactured = Manufactured{.type = "mms_1", .amplitude = 2};
  euler::Gas stiff{.gamma = 1.4, .pInfinity = 1e5, .specificHeat = 717.5}, spheres = stiff;
  spheres.law = std::make_shared<const euler::Gas::Law>(
      euler::RealGas({.gasConstant = 287, .specificHeat = 717.5, .covolume = .3}));
  for (const euler::Gas& gas : {stiff, spheres}) {
    Vec3 velocity = Vec3::Zero();
    double temperature = 300;
    start.apply({.3, .7, 0}, {.density = 1.2, .gas = gas}, velocity, temperature);
    const double pressure = gas.pressureOf(1.2, gas.lastAt(1.2, temperature));
    EXPECT_NEAR(pressure, 101325 - (std::cos(.6) + std::cos(1.4)), 1e-8);
  }
}

TEST(CustomStart, OfTaylorsAndGreensVortexHasNoDivergence) {
  CustomStart start;
  start.manufactured = Manufactured{.type = "mms_3", .angle = .4};
  const double step = 1e-5;
  double divergence = 0, temperature = 300;
  for (int axis = 0; axis < 3; ++axis)
    for (const int sign : {-1, 1}) {
      Vec3 x(.3, .7, 1.1), velocity = Vec3::Zero();
      x[axis] += sign * step;
      start.apply(x, {.density = 1}, velocity, temperature);
      divergence += sign * velocity[axis] / (2 * step);
    }
  EXPECT_NEAR(divergence, 0, 1e-9);
}

TEST(CustomStart, HasOneFlow) {
  CustomStart start;
  start.counterflow = Counterflow{2000};
  EXPECT_EQ(start.problem(1), "");
  start.manufactured = Manufactured{"mms_1"};
  EXPECT_EQ(start.problem(1),
            "give only one of vortices, counterflow and manufacturedSolution, since each defines the velocity");
  start.counterflow.reset();
  EXPECT_EQ(start.problem(1), "");
  EXPECT_NE(start.problem(2), "");
  EXPECT_NE(
      start.problem(1, {.law = std::make_shared<const euler::Gas::Law>(euler::CurvedGas(euler::ColdCurve(), 0, 1))}),
      "");
}

}  // namespace
}  // namespace tushar::ice
