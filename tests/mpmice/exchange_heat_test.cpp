<<<<<<< HEAD
#include "tests/mpmice/fields.hpp"

#include "components/mpmice/tasks/exchange_heat.hpp"

=======
#include "components/mpmice/tasks/exchange_heat.hpp"

#include <gtest/gtest.h>

>>>>>>> lv
namespace tushar::mpmice {

namespace {

<<<<<<< HEAD
/// Two bodies and the gas.
WarmThings three() {
  WarmThings things{Eigen::VectorXd(3), Eigen::VectorXd(3), Eigen::VectorXd(3)};
  things.capacity << 200, 50, 3;
  things.temperature << 300, 500, 1000;
  things.volume << 0.2, 0.3, 0.5;
  return things;
}

}  // namespace

TEST(ExchangeOfHeat, KeepsTheHeat) {
  const WarmThings things = three();
  for (const double h : {1e-3, 1.0, 1e3, 1e6}) {
    const Eigen::VectorXd after = temperaturesAfter(things, {0, h, 2 * h}, 1e-3);
    EXPECT_NEAR(after.dot(things.capacity) / things.temperature.dot(things.capacity), 1, 1e-12) << h;
  }
}

TEST(ExchangeOfHeat, EndsAtOneTemperatureWhereItIsStiff) {
  const WarmThings things = three();
  const double mean = things.temperature.dot(things.capacity) / things.capacity.sum();
  const Eigen::VectorXd after = temperaturesAfter(things, {1e15, 1e15, 1e15}, 1e-3);
  for (const double temperature : after) EXPECT_NEAR(temperature / mean, 1, 1e-6);
}

TEST(ExchangeOfHeat, IsThatOfTheImplicitStepOfTwo) {
  WarmThings things{Eigen::VectorXd(2), Eigen::VectorXd(2), Eigen::VectorXd(2)};
  things.capacity << 2, 1;
  things.temperature << 300, 600;
  things.volume << 0.5, 0.5;
  const double flow = 4 * 0.1 * 0.25;  // H dt theta theta
  const double closes = 1 / (1 + flow * (1 / 2.0 + 1 / 1.0));
  const Eigen::VectorXd after = temperaturesAfter(things, {4}, 0.1);
  EXPECT_NEAR(after[1] - after[0], 300 * closes, 1e-10);
}

TEST(ExchangeOfHeat, LeavesAloneWhatIsNotThere) {
  WarmThings things = three();
  things.capacity[1] = things.temperature[1] = things.volume[1] = 0;
  const Eigen::VectorXd after = temperaturesAfter(things, {1e6, 0, 1e6}, 1e-3);
  EXPECT_DOUBLE_EQ(after[0], 300);
  EXPECT_DOUBLE_EQ(after[2], 1000);
=======
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
>>>>>>> lv
}

}  // namespace tushar::mpmice
