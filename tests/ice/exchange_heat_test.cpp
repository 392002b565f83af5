#include "components/ice/mixture/exchange_heat.hpp"

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace tushar::ice {

namespace {

/// Two bodies and a gas in the same cell.
WarmThings<> threeThings() {
  WarmThings<> things(3);
  things.capacity << 4000, 1000, 2;
  things.temperature << 300, 500, 2000;
  things.volume << 0.5, 0.2, 0.3;
  return things;
}

Eigen::VectorXd temperaturesAfter(const WarmThings<>& things, const std::vector<double>& pairs, double dt) {
  return things.temperature + changesByHeat(things, {pairs}, dt).temperature;
}

/// A stiffened gas and an ideal gas at a pressure of 3e8 Pa, and a body at 400 K.
struct CellOfGases {
  euler::Gas water{.gamma = 4.4, .pInfinity = 6e8, .specificHeat = 1000}, air{.gamma = 1.4, .specificHeat = 700};
  double pressure = 3e8, massOfWater = 400, massOfAir = 100;

  WarmThings<> things() const {
    WarmThings<> all(3);
    all.capacity[0] = 5e5;
    all.temperature[0] = 400;
    all.volume[0] = 0.25;
    all.setGas(1, water, massOfWater, 0.5, pressure);
    all.setGas(2, air, massOfAir, 0.25, pressure);
    return all;
  }
  double energyOf(double volumeOfWater, double volumeOfAir, double p) const {
    return volumeOfWater * water.energyOf(0, p) + volumeOfAir * air.energyOf(0, p);
  }
  /// Returns the pressure of a mass of gas in a volume at a temperature.
  static double pressureOf(const euler::Gas& gas, double mass, double volume, double temperature) {
    return mass * gas.gasConstant() * temperature / volume - gas.pInfinity;
  }
};

const std::string tube = "ups/ice/two_gases.ups";

std::string withHeat(const std::string& scene, const std::string& heat) {
  return test::changedScene(scene, "<heat>[0]", "<heat>[" + heat + "]");
}

}  // namespace

TEST(ChangesByHeat, MakeOneTemperatureWhereExchangeIsStiff) {
  const WarmThings<> things = threeThings();
  const double common = things.capacity.dot(things.temperature) / things.capacity.sum();
  for (const double temperature : temperaturesAfter(things, {1e15, 1e15, 1e15}, 1e-3))
    EXPECT_NEAR(temperature, common, 1e-6 * common);
}

TEST(ChangesByHeat, KeepTheHeat) {
  const WarmThings<> things = threeThings();
  const double before = things.capacity.dot(things.temperature);
  EXPECT_NEAR(things.capacity.dot(temperaturesAfter(things, {3e4, 1e5, 2e6}, 1e-2)), before, 1e-14 * before);
}

TEST(ChangesByHeat, FollowTheImplicitStepOfAPair) {
  const double h = 50, dt = 1e-2;
  const Eigen::VectorXd after = temperaturesAfter(threeThings(), {0, h, 0}, dt);

  const double flow = h * dt * 0.5 * 0.3;  // H dt theta_a theta_b
  const double difference = 1700 / (1 + flow * (1 / 4000.0 + 1 / 2.0));
  EXPECT_NEAR(after[2] - after[0], difference, 1e-9 * difference);
  EXPECT_DOUBLE_EQ(after[1], 500);
}

TEST(ChangesByHeat, LeaveOutWhatIsNotThere) {
  WarmThings<> things = threeThings();
  things.capacity[1] = things.temperature[1] = things.volume[1] = 0;
  const Eigen::VectorXd after = temperaturesAfter(things, {1e15, 1e15, 1e15}, 1e-3);

  EXPECT_NEAR(after[0], after[2], 1e-6 * after[0]);
  EXPECT_EQ(after[1], 0);
}

TEST(ChangesByHeat, AreNoneWhereAllIsAsWarm) {
  WarmThings<> things = CellOfGases().things();
  things.temperature.setConstant(300);
  const auto changes = changesByHeat(things, {{1e15, 1e15, 1e15}}, 1e-3);
  EXPECT_TRUE(changes.temperature.isZero(0));
  EXPECT_TRUE(changes.volume.isZero(0));
}

TEST(ChangesByHeat, LetGasesExpandAtOnePressure) {
  const CellOfGases cell;
  const WarmThings<> things = cell.things();
  for (const double h : {1e9, 1e15}) {
    const auto changes = changesByHeat(things, {{h, h, h}}, 1e-3);
    const double water = 0.5 + changes.volume[1], air = 0.25 + changes.volume[2];
    EXPECT_NEAR(water + air, 0.75, 1e-15);
    const double ofWater =
        CellOfGases::pressureOf(cell.water, cell.massOfWater, water, things.temperature[1] + changes.temperature[1]);
    const double ofAir =
        CellOfGases::pressureOf(cell.air, cell.massOfAir, air, things.temperature[2] + changes.temperature[2]);
    EXPECT_NEAR(ofWater, ofAir, 1e-13 * (ofAir + cell.water.pInfinity));
    // The pressure that follows from their energy once the body has taken its heat. The stiffest exchange is 1e8 times
    // the capacities, so that this much of round-off shows.
    const double heat = things.capacity[0] * changes.temperature[0];
    const double energy = cell.energyOf(0.5, 0.25, cell.pressure) - heat;
    EXPECT_NEAR(cell.energyOf(water, air, ofAir), energy, 1e8 * 1e-16 * std::abs(heat) + 1e-14 * energy);
  }
}

TEST(ChangesByHeat, MakeOneTemperatureOfGasesAndABody) {
  const WarmThings<> things = CellOfGases().things();
  const Eigen::VectorXd after = temperaturesAfter(things, {1e15, 1e15, 1e15}, 1);
  EXPECT_NEAR(after[1], after[0], 1e-6 * after[0]);
  EXPECT_NEAR(after[2], after[0], 1e-6 * after[0]);
}

TEST(ChangesByHeat, KeepThePressureOfIdealGasesOfOneGamma) {
  const euler::Gas air{.gamma = 1.4, .specificHeat = 700}, other{.gamma = 1.4, .specificHeat = 2500};
  WarmThings<euler::kMostGases> things(2);
  things.setGas(0, air, 0.3, 0.4, 1e5);
  things.setGas(1, other, 0.1, 0.6, 1e5);
  const auto changes = changesByHeat(things, {{200}}, 1e-2);
  EXPECT_GT(std::abs(changes.volume[0]), 1e-4);
  for (const Eigen::Index k : {0, 1}) {
    const double volume = things.volume[k] + changes.volume[k];
    EXPECT_NEAR(things.expansion[k] * (things.temperature[k] + changes.temperature[k]) / volume, 1e5, 1e-10);
  }
}

TEST(HeatCoefficients, GoByTheRatioOfMassesWithinLimits) {
  const HeatCoefficients byMasses{{}, true};
  EXPECT_EQ(byMasses.of(0, 1, 2), 1e5);
  EXPECT_NEAR(byMasses.of(0, 1e4, 1), 1e8, 1e-6);
  EXPECT_NEAR(byMasses.of(0, 1, 1e4), 1e8, 1e-6);
  EXPECT_EQ(byMasses.of(0, 1e-9, 1), 1e12);
  EXPECT_EQ((HeatCoefficients{{3, 5}}).of(1, 1e-9, 1), 5);
}

TEST(HeatBetweenGases, ChangesARunAndKeepsMassMomentumAndEnergy) {
  const std::string none = test::runScene(tube, {}).fingerprint;
  for (const char* heat : {"10", "1e15"}) {
    const report::Report report = test::runScene(withHeat(tube, heat), {});
    EXPECT_NE(report.fingerprint, none) << heat;
    for (const char* name : {"mass", "energy"}) EXPECT_NEAR(test::driftOf(report, name), 0, 1e-14) << heat;
  }
}

TEST(HeatBetweenGases, HasOneFingerprintOnAnyPatches) {
  const std::string scene =
      test::changedScene("ups/ice/three_gases.ups", "<heat>[0,0,0]</heat>", "<heat>[2,0,30]</heat>");
  std::vector<std::string> overrides{"Time/maxTime=0.1", "Grid/Level/Box/resolution=[16,16,1]"};
  const report::Report whole = test::runScene(scene, overrides);
  for (const char* name : {"mass", "momentum", "energy"}) EXPECT_NEAR(test::driftOf(whole, name), 0, 1e-14) << name;
  overrides.push_back("Grid/Level/Box/patches=[4,2,1]");
  EXPECT_EQ(test::runScene(scene, overrides).fingerprint, whole.fingerprint);
}

namespace {

/// A scene whose gases have heat sources.
std::string heated(const std::string& scene, const std::string& tags) {
  return test::changedScene(scene, "<ICE><advection type=\"SecondOrder\"/>",
                            "<ICE><advection type=\"SecondOrder\"/><ADD_HEAT>" + tags + "</ADD_HEAT>");
}
std::string heatTags(const std::string& materials, const std::string& rates, const std::string& end) {
  return "<add_heat_matls>" + materials + "</add_heat_matls><add_heat_coeff>" + rates +
         "</add_heat_coeff><add_heat_t_start>0</add_heat_t_start><add_heat_t_final>" + end + "</add_heat_t_final>";
}

}  // namespace

TEST(Heating, LastsFromItsStartToItsEnd) {
  const Heating heating{{}, {0, 5}, 0.2, 0.4};
  EXPECT_TRUE(heating.acts());
  EXPECT_EQ(heating.inStep(1, 0.25, 0.125), 0.625);
  EXPECT_EQ(heating.inStep(0, 0.25, 0.125), 0);
  EXPECT_EQ(heating.inStep(1, 0.41, 0.5), 0);
  EXPECT_EQ(heating.inStep(1, 0, 0.1), 0);
  EXPECT_NEAR(heating.inStep(1, 0.1, 0.5), 1, 1e-15) << "a step that contains the period";
  EXPECT_NEAR(heating.inStep(1, 0.1, 0.15), 0.25, 1e-15);
  EXPECT_NEAR(heating.inStep(1, 0.375, 0.5), 0.125, 1e-15);
  EXPECT_FALSE((Heating{{}, {0, 0}, 0, 1}).acts());
}

TEST(Heating, OfOneOfTwoGasesMakesThatOneWarm) {
  WarmThings<> things(2);
  things.setGas(0, {.gamma = 1.4, .specificHeat = 700}, 0.5, 0.5, 1e5);
  things.setGas(1, {.gamma = 1.4, .specificHeat = 700}, 0.5, 0.5, 1e5);
  giveHeat(things, {{}, {0, 3e4}, 0, 1}, 0, 1e-1, 0);
  EXPECT_DOUBLE_EQ(things.given[1], 1500);
  const auto changes = changesByHeat(things, {}, 1e-1);
  // p rises by (gamma - 1) times the heat; the other gas is compressed without heat.
  const double after = 1e5 + 0.4 * 1500;
  EXPECT_NEAR(things.expansion[0] * (things.temperature[0] + changes.temperature[0]) / (0.5 + changes.volume[0]), after,
              1e-7);
  EXPECT_LT(changes.volume[0], 0);
  EXPECT_NEAR(changes.volume[0] + changes.volume[1], 0, 1e-15);
  EXPECT_GT(changes.temperature[1], 2 * changes.temperature[0]);
}

TEST(Heating, AddsItsEnergyToAGasAndToSeveral) {
  const auto rise = [](const std::string& scene) { return test::driftOf(test::runScene(scene, {}), "energy"); };
  const std::string sod = "ups/ice/sod.ups";
  const double one = rise(heated(sod, heatTags("[0]", "[0.3]", "1")));
  EXPECT_GT(one, 0.005);
  EXPECT_NEAR(rise(heated(sod, heatTags("[0]", "[0.6]", "1"))) / one, 2, 1e-6);
  EXPECT_GT(rise(heated(tube, heatTags("[1]", "[0.3]", "1"))), 1e-4);
  EXPECT_NEAR(rise(heated(tube, heatTags("[1]", "[0]", "1"))), 0, 1e-14);
}

TEST(Heating, IsForGasesOfTheScene) {
  EXPECT_EQ(test::problemOf(heated(tube, heatTags("[2]", "[1]", "1"))),
            "material 2 is not available: only gases can be heated, which have indices 0 to 1");
  EXPECT_EQ(test::problemOf(heated(tube, heatTags("[0,1]", "[1]", "1"))),
            "found 2 materials and 1 coefficients, expected one coefficient for each material");
  EXPECT_EQ(test::problemOf(heated(tube, heatTags("[]", "[]", "1"))), "found no materials, expected at least one");
  EXPECT_EQ(test::problemOf(heated(tube, heatTags("[1,1]", "[1,2]", "1"))), "material 1 is given twice");
  EXPECT_EQ(test::problemOf(heated(tube, heatTags("[1]", "[1]", "-1"))),
            "found <add_heat_t_final> -1, expected at least <add_heat_t_start>, 0");
}

}  // namespace tushar::ice
