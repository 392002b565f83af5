#include "components/mpmice/tasks/exchange_heat.hpp"

#include <gtest/gtest.h>

namespace tushar::mpmice {

namespace {

/// Two bodies and a gas that share a cell.
WarmThings threeThings() {
  WarmThings things{Eigen::VectorXd(3), Eigen::VectorXd(3), Eigen::VectorXd(3)};
  things.capacity << 4000, 1000, 2;
  things.temperature << 300, 500, 2000;
  things.volume << 0.5, 0.2, 0.3;
  return things;
}

double heatOf(const WarmThings& things, const Eigen::VectorXd& temperature) { return things.capacity.dot(temperature); }

}  // namespace

TEST(TemperaturesAfter, AreOneWhereExchangeIsStiff) {
  const WarmThings things = threeThings();
  const Eigen::VectorXd after = temperaturesAfter(things, {1e15, 1e15, 1e15}, 1e-3);

  const double common = heatOf(things, things.temperature) / things.capacity.sum();
  for (const double temperature : after) EXPECT_NEAR(temperature, common, 1e-6 * common);
}

TEST(TemperaturesAfter, KeepTheHeat) {
  const WarmThings things = threeThings();
  const Eigen::VectorXd after = temperaturesAfter(things, {3e4, 1e5, 2e6}, 1e-2);

  EXPECT_NEAR(heatOf(things, after), heatOf(things, things.temperature), 1e-12 * heatOf(things, things.temperature));
}

TEST(TemperaturesAfter, FollowTheImplicitStepOfAPair) {
  WarmThings things = threeThings();
  const double h = 50, dt = 1e-2;
  const Eigen::VectorXd after = temperaturesAfter(things, {0, h, 0}, dt);

  const double flow = h * dt * 0.5 * 0.3;  // H dt theta_a theta_b
  const double difference = 1700 / (1 + flow * (1 / 4000.0 + 1 / 2.0));
  EXPECT_NEAR(after[2] - after[0], difference, 1e-9 * difference);
  EXPECT_DOUBLE_EQ(after[1], 500);
}

TEST(TemperaturesAfter, LeaveOutWhatIsNotThere) {
  WarmThings things = threeThings();
  things.capacity[1] = things.temperature[1] = things.volume[1] = 0;
  const Eigen::VectorXd after = temperaturesAfter(things, {1e15, 1e15, 1e15}, 1e-3);

  EXPECT_NEAR(after[0], after[2], 1e-6 * after[0]);
  EXPECT_EQ(after[1], 0);
}

}  // namespace tushar::mpmice
