#include "tests/mpmice/fields.hpp"

#include "components/mpmice/wall_exchange.hpp"

namespace tushar::mpmice {

namespace {

namespace lane = mpm::solid::lane;
using mpm::solid::NodeRecord;

/// Five cells on a line: two with gas, one that is free but holds none, and a body that moves away from them.
struct Vacuum {
  static constexpr int empty = 2;

  Vacuum() {
    for (int k = empty; k < 5; ++k) gas.density.values[k] = gas.energy.values[k] = 0;
    for (int k = empty + 1; k < 5; ++k) gas.free.values[k] = newFree.values[k] = 0;
    gas.coverage.values[empty + 1][0] = 0.5;
    for (int k = empty; k < 6; ++k) {
      records.values[k][lane::mass] = 1;
      mpm::solid::setLanes<1>(records.values[k], lane::velocity, Vec<1>::Constant(0.7));
      mpm::solid::setLanes<1>(records.values[k], lane::before, Vec<1>::Constant(0.7));
    }
  }
  /// Returns the density of a cell after the effect of walls.
  double densityAfter(int cell) {
    Field<double> density = gas.density, energy = gas.energy;
    Field<Vec<1>> momentum = gas.momentum;
    const GasInCells<1> cells = gas.gas();
    const BodiesInStep<1> step{{below.seen(), below.seen()}, newFree.seen(), swept.seen(), sweptBy.seen()};
    const typename BodiesAtNodes<1>::Records bodies{{records.seenNodes()}};
    const WallExchange<1> exchange(level, settings, cells, step, bodies, 0, 0.01);
    exchange.addTo({cell}, {{density.cells(), momentum.cells(), energy.cells()}, {}, {}}, {});
    return density.values[cell];
  }

  Level level{euler::closedBox(1, 5)};
  Settings settings;
  GasFields<1> gas{level.cells()};
  Field<double> newFree{level.cells(), 1};
  Field<Vec<1>> below{level.cells(), Vec<1>::Zero()}, swept{below},
      sweptBy{level.cells(), Vec<1>::Constant(c::notSwept)};
  Field<NodeRecord> records{level.nodes(), NodeRecord{}};
};

/// Five cells on a line, with a body that fills the third one. Its boxes have not moved, although its nodes have.
struct Plate : Vacuum {
  static constexpr int body = 2;

  Plate() {
    for (int k = 0; k < 5; ++k) {
      gas.density.values[k] = k < body ? 100 : k > body ? 1 : 0;
      gas.energy.values[k] = 2.5 * gas.density.values[k];
      gas.free.values[k] = newFree.values[k] = k == body ? 0 : 1;
      gas.coverage.values[k][0] = k == body || k == body + 1 ? 1 : 0;
    }
  }
};

}  // namespace

TEST(WallExchange, PassesNoGasThroughACellThatABodyFills) {
  for (const double velocity : {-0.7, 0.7}) {
    Plate line;
    for (int k = 2; k < 6; ++k)
      mpm::solid::setLanes<1>(line.records.values[k], lane::velocity, Vec<1>::Constant(velocity));
    EXPECT_EQ(line.densityAfter(Plate::body - 1), 100);
    EXPECT_EQ(line.densityAfter(Plate::body), 0);
    EXPECT_EQ(line.densityAfter(Plate::body + 1), 1);
    line.newFree.values[Plate::body] = 1e-3;  // as much as this has room in it, from the side from which it comes
    EXPECT_NEAR(line.densityAfter(Plate::body), velocity > 0 ? 0.1 : 1e-3, 1e-15);
  }
}

TEST(WallExchange, TakesNoGasFromAFreeCellThatHasNone) {
  Vacuum line;
  EXPECT_EQ(line.densityAfter(Vacuum::empty), 0);
  EXPECT_EQ(line.densityAfter(Vacuum::empty + 1), 0);
}

TEST(WallExchange, TakesGasThatFollowsAWallFromASmallCellWithAFreeNeighbour) {
  Vacuum line;  // The small cell is merged with its neighbour after the step.
  line.newFree.values[Vacuum::empty] = line.gas.free.values[Vacuum::empty] = 0.2;
  EXPECT_NEAR(line.densityAfter(Vacuum::empty + 1), 0.7 * 0.01 / line.level.spacing(0), 1e-15);
}

TEST(WallExchange, TakesNoGasFromASmallCellThatMayBeMergedWithAnEmptyOne) {
  Vacuum line;
  line.newFree.values[Vacuum::empty] = line.gas.free.values[Vacuum::empty] = 0.2;
  line.newFree.values[Vacuum::empty + 1] = 0.6;
  EXPECT_EQ(line.densityAfter(Vacuum::empty + 1), 0);
}

}  // namespace tushar::mpmice
