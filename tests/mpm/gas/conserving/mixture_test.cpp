#include "components/mpm/gas/conserving/mixture.hpp"

#include <gtest/gtest.h>

#include "core/grid/patch.hpp"
#include "tests/support/levels.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

Gas gasOf(double gamma, double pInfinity) {
  Gas gas;
  gas.gamma = gamma;
  gas.pInfinity = gas.carried = pInfinity;
  return gas;
}

/// A cell of 1 m³ with water in a fraction of it and air in the rest, at different pressures.
struct WaterAndAir {
  static constexpr double volume = 1;
  const std::vector<Gas> gases{gasOf(4.4, 6e8), gasOf(1.4, 0)};
  std::array<double, 2> mass, energy, fill;
  std::vector<GasInCells> held;
  const Cells cells{gases, held};

  WaterAndAir(double share, double waterPressure, double airPressure)
      : mass{1000 * share, 50 * (1 - share)},
        energy{share * Mixture::energyAt(waterPressure, gases[0]),
               (1 - share) * Mixture::energyAt(airPressure, gases[1])},
        fill{share, 1 - share} {
    const Box one{{}, Index3::filled(1)};
    for (std::size_t k = 0; k < 2; ++k)
      held.push_back({.mass = {&mass[k], one}, .internalEnergy = {&energy[k], one}, .fill = {&fill[k], one}});
  }
  WaterAndAir(const WaterAndAir&) = delete;
  WaterAndAir& operator=(const WaterAndAir&) = delete;

  Mixture mixture() const { return cells.at(Index<1>{}, volume); }
  SharedWork<Index<1>> shared(double work) const { return {cells, cell, volume, work}; }
  /// Returns the internal energies after work has been distributed.
  std::array<double, 2> after(double work) const {
    const auto change = shared(work);
    return {energy[0] * (1 + change(0)), energy[1] * (1 + change(1))};
  }
  const Index<1> cell{};
};

}  // namespace

TEST(Mixture, OfGasesAtOnePressureHasThatPressureWhateverTheirShares) {
  for (const double share : {1e-9, 0.1, 0.5, 0.999})
    EXPECT_NEAR(WaterAndAir(share, 3e5, 3e5).mixture().pressure(), 3e5, 1e-5);  // round-off of gamma p_inf = 2.6e9 Pa
}

TEST(Mixture, OfOneGasHasItsPressureAndSpeedOfSound) {
  const Mixture water = WaterAndAir(1, 1e7, 0).mixture(), air = WaterAndAir(0, 0, 1e5).mixture();
  EXPECT_NEAR(water.pressure(), 1e7, 1e-5);
  EXPECT_NEAR(water.soundSpeedSquared(), 4.4 * (1e7 + 6e8) / 1000, 1e-6);
  EXPECT_DOUBLE_EQ(air.soundSpeedSquared(), 1.4 * 1e5 / 50);
}

TEST(SharedWork, LeavesAllGasesAtThePressureOfTheMixture) {
  const WaterAndAir cell(0.4, 5e6, 1e5);
  const double work = 2e5;

  const auto [water, air] = cell.after(work);

  const double waterPressure = 3.4 * water / 0.4 - 4.4 * 6e8, airPressure = 0.4 * air / 0.6;
  EXPECT_NEAR(waterPressure / airPressure, 1, 1e-9);
  EXPECT_NEAR(water + air, cell.energy[0] + cell.energy[1] + work, 1e-14 * cell.energy[0]);
}

TEST(SharedWork, TakesAtMostHalfOfTheEnergyOfAGas) {
  const WaterAndAir cell(0.9, -5e7, 1e5);  // of the mixture: -2.6e7 Pa, at which air has none
  const auto [water, air] = cell.after(0);

  EXPECT_LT(cell.mixture().pressure(), 0);
  EXPECT_NEAR(air, 0.5 * cell.energy[1], 1e-6 * air);
  EXPECT_NEAR(water + air, cell.energy[0] + cell.energy[1], 1e-14 * cell.energy[0]);
}

TEST(SharedWork, OfOneGasIsAllItsOwn) {
  const WaterAndAir cell(1, 1e7, 0);
  EXPECT_DOUBLE_EQ(cell.shared(1e3)(0), 1e3 / cell.energy[0]);
  EXPECT_EQ(cell.shared(1e3)(1), 0);
}

TEST(MixAtNodes, GivesAllGasesTheVelocityOfTheirMomentum) {
  const Grid grid{test::domain({{1, 1, 1}})};
  std::array<double, 2> water{3, 0}, air{1, 0};
  std::array<Vec<1>, 2> fast{Vec<1>(4), Vec<1>(0)}, slow{Vec<1>(-4), Vec<1>(0)};
  const Box nodes{{}, {{2, 1, 1}}};

  mixAtNodes<1>(grid.patches().front(), std::vector{gasOf(4.4, 6e8), gasOf(1.4, 0)},
                {NodeView<double>(water.data(), nodes), NodeView<double>(air.data(), nodes)},
                {NodeView<Vec<1>>(fast.data(), nodes), NodeView<Vec<1>>(slow.data(), nodes)});

  EXPECT_EQ(water[0], 4);
  EXPECT_EQ(air[0], 4);
  EXPECT_EQ(fast[0], Vec<1>(2));
  EXPECT_EQ(slow[0], Vec<1>(2));
  EXPECT_EQ(slow[1], Vec<1>(0));  // of a node that no gas touches
}

}  // namespace tushar::mpm::gas::conserving
