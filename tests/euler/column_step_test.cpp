#include "components/euler/tasks/column_step.hpp"

#include <gtest/gtest.h>

#include "tests/euler/gas_box.hpp"

namespace tushar::euler {

namespace {

/// The states of all cells of a level.
struct Fields {
  explicit Fields(const Level& level)
      : cells(level.cells()), density(cells.size()), energy(cells.size()), momentum(cells.size()) {}

  template <class T = double>
  StateViews<3, T> views() {
    return {{density.data(), cells}, {momentum.data(), cells}, {energy.data(), cells}};
  }

  Box cells;
  std::vector<double> density, energy;
  std::vector<Vec<3>> momentum;
};

Fields roughFields(const Level& level, const StiffenedGas& gas) {
  Fields fields(level);
  const StateViews<3, double> views = fields.views();
  forEach<3>(level.cells(), [&](const Index<3>& cell) {
    const State<3> u = conserved<3>(gas, roughGas<3>(level.cellCentre<3>(cell)));
    views.density[cell] = u[kDensity];
    for (int d = 0; d < 3; ++d) views.momentum[cell][d] = u[kVelocity(d)];
    views.totalEnergy[cell] = u[kPressure<3>];
  });
  return fields;
}

/// A level with the given resolution and either walls or open sides all around.
grid::Domain boxOf(const Index3& resolution, bool hasWalls) {
  grid::Domain domain = hasWalls ? closedBox(3, 1) : openBox(3, 1);
  domain.resolution = resolution;
  return domain;
}

template <class Shape>
void expectBitsOfABlock(const grid::Domain& domain, const Index3& extents) {
  const Grid grid(domain);
  const Level& level = grid.level();
  const StiffenedGas gas{1.4, 0.2};
  const GhostRules<3> rules = ghostRules<3>(level, Gas{1.4, 0.2});
  Fields old = roughFields(level, gas), byBlock(level), byColumns(level);
  const StateViews<3, const double> before = old.views<const double>();
  const StateViews<3, double> expected = byBlock.views(), fresh = byColumns.views();
  const double dt = 1e-3;
  Work<3> work(level.cells(), Shape::reach);
  advanceBlock<3, Hllc, Shape>(gas, level, rules, level.cells(), dt, before, work, expected, {});

  const RimFluxes<3> rims;
  ColumnStep<Hllc, Shape, StiffenedGas> step(gas, level, rules, extents, dt, before, fresh, rims);
  std::size_t finished = 0;
  forEachBlock<3>(level.cells(), extents,
                  [&](const Box& column) { step.run(column, [&](const Box& plane) { finished += plane.size(); }); });
  EXPECT_EQ(finished, level.cells().size());
  EXPECT_EQ(byColumns.density, byBlock.density);
  EXPECT_EQ(byColumns.energy, byBlock.energy);
  EXPECT_EQ(byColumns.momentum, byBlock.momentum);
}

}  // namespace

TEST(ColumnStep, HasTheBitsOfABlock) {
  for (const bool hasWalls : {true, false})
    for (const int height : {2, 3, 7}) {
      const grid::Domain domain = boxOf({{9, 6, height}}, hasWalls);
      for (const Index3& extents : {Index3{{9, 6, height}}, Index3{{4, 5, height}}, Index3{{1, 1, height}}}) {
        expectBitsOfABlock<Constant>(domain, extents);
        expectBitsOfABlock<Sloped<VanLeer>>(domain, extents);
      }
    }
}

TEST(ColumnStep, ColumnsTileAPatchWithinTheCache) {
  for (const Index3& extents :
       {Index3{{128, 128, 64}}, Index3{{16, 16, 16}}, Index3{{3, 4000, 2}}, Index3{{1, 1, 1}}}) {
    const Index3 column = columnOf({{}, extents}, 2);
    EXPECT_EQ(column[2], extents[2]);
    EXPECT_LE((column[0] + 4) * (column[1] + 4), std::max(kColumnCells, (kColumnWidth + 4) * 5));
    for (int d = 0; d < 3; ++d) {
      EXPECT_GE(column[d], 1);
      EXPECT_LE(column[d], extents[d]);
    }
  }
}

}  // namespace tushar::euler
