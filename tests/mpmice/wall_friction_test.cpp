#include "components/mpmice/wall_friction.hpp"

#include "tests/mpmice/fields.hpp"

namespace tushar::mpmice {

namespace {

/// A plane grid of 6 rows: a body fills the upper two, and the fourth has the given free volume fraction.
struct Plate {
  explicit Plate(double room) : grid(euler::closedBox(2, 6)), gas(grid.level().cells()) {
    forEach<2>(grid.level().cells(), [&](const Index<2>& cell) {
      if (cell[1] < 3) return;
      gas.free.cells()[cell] = cell[1] == 3 ? room : 0;
      gas.density.cells()[cell] = gas.free.cells()[cell];
      if (cell[1] > 3) gas.coverage.cells()[cell][1] = 1;
      if (cell[1] > 3) gas.coverage.cells()[cell][0] = 1;
      if (cell[1] == 3) gas.coverage.cells()[cell][0] = 1 - room;
    });
  }
  CellFriction<2> of(const Index<2>& cell, double mass = 1, double viscosity = 0.5, double coefficient = 0) const {
    const GasInCells<2> cells = gas.gas();
    const FreeSpace<2> space(grid.level(), {}, cells);
    return {grid.level(),
            space,
            cell,
            cells.free[cell],
            viscosity,
            [&](const Index<2>&, int) { return mass; },
            [&](const Index<2>&, int) { return coefficient; }};
  }

  Grid grid;
  GasFields<2> gas;
};

}  // namespace

TEST(CellFriction, IsViscosityOverTheDistanceFromTheWall) {
  const double h = 1.0 / 6;
  const Plate full(1), half(0.6), narrow(0.3);
  EXPECT_NEAR(full.of({2, 3}).all(), 0.5 / (h * 0.5 * h), 1e-11);
  EXPECT_NEAR(half.of({2, 3}).all(), 0.5 / (h * 0.5 * 0.6 * h), 1e-11);
  EXPECT_NEAR(narrow.of({2, 3}).all(), 0.5 / (h * 0.5 * 1.3 * h), 1e-11) << "with the cell that shares its gas";
  EXPECT_EQ(full.of({2, 3}).share(1, 1), 1);
  EXPECT_EQ(full.of({2, 2}).all(), 0) << "away from the wall";
}

TEST(CellFriction, IsAQuarterOfACellTimesACoefficient) {
  for (const double room : {1.0, 0.6, 0.3}) EXPECT_NEAR(Plate(room).of({2, 3}, 1, 0, 8).all(), 2, 1e-13) << room;
  EXPECT_EQ(Plate(1).of({2, 3}, 0, 0, 8).all(), 0) << "without a mass to take it";
}

TEST(CellFriction, ActsAlongTheWall) {
  const Vec<2> along = Plate(1).of({2, 3}).alongWalls(Vec<2>(0.3, 0.7));
  EXPECT_NEAR(along[0], 0.3, 1e-15);
  EXPECT_NEAR(along[1], 0, 1e-15);
}

TEST(CellFriction, IsNoneWhereNoBodyCanTakeIt) { EXPECT_EQ(Plate(1).of({2, 3}, 0).all(), 0); }

}  // namespace tushar::mpmice
