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
  start.apply({-7, .1 + .3, .2 - .1}, rho, velocity, temperature);
  const double turn = strength / (rho * radius * radius) * std::exp(-(.09 + .01) / (2 * .25));
  EXPECT_LT((velocity - Vec3(1, 2 + turn * .1, 3 + turn * .3)).norm(), 1e-12);
  EXPECT_EQ(temperature, 300);
  start.apply({0, .1 + .5001, .2}, rho, velocity = Vec3(1, 2, 3), temperature);
  EXPECT_EQ(velocity, Vec3(1, 2, 3));
}

TEST(CustomStart, VorticesAddUp) {
  CustomStart start;
  start.vortices = VortexList{{{2, {0, 0, 0}, 10, .5}, {2, {0, 0, 0}, -10, .5}}};
  Vec3 velocity = Vec3::Zero();
  double temperature = 300;
  start.apply({.1, .2, 0}, 1, velocity, temperature);
  EXPECT_LT(velocity.norm(), 1e-12);
}

TEST(CustomStart, ABellStandsOnTheTemperatureOf300K) {
  CustomStart start;
  start.temperature = GaussianTemperature{700, {.5, .5, 0}, .1, .2};
  Vec3 velocity = Vec3::Zero();
  double temperature = 1;
  start.apply({.5, .5, 4}, 1, velocity, temperature);
  EXPECT_DOUBLE_EQ(temperature, 1000);
  start.apply({.6, .9, 4}, 1, velocity, temperature);
  EXPECT_NEAR(temperature, 300 + 700 * std::exp(-.5 - 2), 1e-10);
  start.apply({100, 100, 4}, 1, velocity, temperature);
  EXPECT_EQ(temperature, 300);
}

}  // namespace
}  // namespace tushar::ice
