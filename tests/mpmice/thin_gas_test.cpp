#include "components/mpmice/thin_gas.hpp"

#include "tests/mpmice/fields.hpp"

namespace tushar::mpmice {

namespace {

/// Viscous gas at rest in a closed box of 4 x 4 cells, with a given density in the cell (2, 2), and density 1
/// elsewhere.
struct ThinCell {
  explicit ThinCell(double density) : grid(euler::closedBox(2, 4)), gas(grid.level().cells()) {
    settings.gas.gas.gamma = 1.4;
    settings.gas.gas.specificHeat = 2.5;
    settings.diffusion.alone.uniform = {.viscosity = 3e-4, .conductivity = 1e-3};
    forEach<2>(grid.level().cells(), [&](const Index<2>& cell) {
      gas.density.cells()[cell] = cell == thin ? density : 1;
      gas.energy.cells()[cell] = 2.5 * gas.density.cells()[cell];
    });
  }
  double soundSpeed() const { return std::sqrt(1.4); }
  double width() const { return grid.level().spacing(0); }
  BoundedDiffusion<2> diffusion(double atStart) const { return {grid.level(), settings, cells, atStart}; }

  Index<2> thin{2, 2}, below{1, 2};
  Settings settings;
  Grid grid;
  GasFields<2> gas;
  GasInCells<2> cells = gas.gas();
};

}  // namespace

TEST(BoundedDiffusion, IsThatOfTheSceneInDenseGas) {
  const ThinCell one(1);
  const auto at = one.diffusion(4e-4).between(one.below, one.thin);
  EXPECT_EQ(at.viscosity, 3e-4);
  EXPECT_EQ(at.conductivity, 1e-3);
  EXPECT_TRUE(one.diffusion(4e-4).thinCells(one.grid.level().cells()).empty());
}

TEST(BoundedDiffusion, IsFreeMolecularInThinGas) {
  const double rho = 1e-12;
  const ThinCell one(rho);
  const auto at = one.diffusion(4e-4).between(one.below, one.thin);
  const double most = rho * one.soundSpeed() * one.width();
  EXPECT_NEAR(at.viscosity / most, 0.75, 1e-12);
  EXPECT_NEAR(at.conductivity / most, 2.5, 1e-12);
  EXPECT_EQ(one.diffusion(4e-4).thinCells(one.grid.level().cells()), std::vector<Index<2>>{one.thin});
}

TEST(BoundedDiffusion, IsNotBoundedInGasThatStartsAsThin) {
  const ThinCell one(1e-12);
  const auto at = one.diffusion(4e8).between(one.below, one.thin);
  EXPECT_EQ(at.viscosity, 3e-4);
  EXPECT_EQ(at.conductivity, 1e-3);
}

TEST(DiffusivityBound, IsASpeedOfSoundTimesACell) {
  const ThinCell one(1);
  EXPECT_EQ(DiffusivityBound(one.grid.level(), 0).at(3), 3 * one.width());
  EXPECT_EQ(DiffusivityBound(one.grid.level(), 7).at(3), 70);
}

}  // namespace tushar::mpmice
