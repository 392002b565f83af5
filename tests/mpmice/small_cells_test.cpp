#include "tests/mpmice/fields.hpp"

#include "components/mpmice/tasks/share_small_cells.hpp"

namespace tushar::mpmice {

namespace {

template <class T>
class SmallCellsAlongAxes : public testing::Test {};
TYPED_TEST_SUITE(SmallCellsAlongAxes, AllAxes);

/// A grid, and a gas before and after small cells are merged with their neighbours.
template <int D>
struct Sharing {
  explicit Sharing(int cells) : grid(euler::closedBox(D, cells)), before(box()), after(box()) {}

  const Level& level() const { return grid.level(); }
  const Box& box() const { return grid.level().cells(); }
  Unshared<D> unshared() const {
    return {.held = before.gas().held, .free = before.free.seen(), .coverage = before.coverage.seen()};
  }
  void share() {
    merged = {};
    leastFree = {};
    const NewGas<D> fresh{{{after.density.cells(), after.momentum.cells(), after.energy.cells()}, {}, {}},
                          after.free.cells()};
    for (const Patch& patch : grid.patches())
      shareSmallCells<D>(patch, Settings{}, unshared(), fresh, {merged, leastFree});
  }
  /// Sets the free volume of a cell and fills it with gas of a density, at rest, at pressure 1.
  void fill(const Index<D>& cell, double free, double density = 1) {
    before.free.cells()[cell] = free;
    before.density.cells()[cell] = free * density;
    before.energy.cells()[cell] = free * 2.5;
  }
  using Targets = std::vector<std::pair<Index<D>, double>>;  ///< targets, and the part of a content that each gets
  Targets targetsOf(const Index<D>& cell) const {
    const Unshared<D> state = unshared();
    Targets targets;
    SmallCells<D>(level(), false, state).forEachTarget(cell, [&](const Index<D>& target, double part) {
      targets.emplace_back(target, part);
    });
    return targets;
  }
  Index<D> targetOf(const Index<D>& cell) const {
    const Targets targets = targetsOf(cell);
    EXPECT_EQ(targets.size(), 1U);
    return targets.front().first;
  }

  Grid grid;
  GasFields<D> before, after;
  Sum merged;
  Minimum leastFree;
};

double sumOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

}  // namespace

/// Round-off does not decide either.
TEST(SmallCells, ShareEquallyAmongNeighboursThatSuitEquallyWell) {
  for (const double roundOff : {-1e-12, 0.0, 1e-12}) {
    Sharing<2> gas(8);
    forEach<2>(cellsAround<2>({4, 4}, 1), [&](const Index<2>& cell) { gas.fill(cell, 0); });
    gas.fill({4, 4}, 0.3);
    gas.fill({3, 4}, 0.9);
    gas.fill({5, 4}, 0.9 + roundOff);
    EXPECT_EQ(gas.targetsOf({4, 4}), (Sharing<2>::Targets{{{3, 4}, 0.5}, {{5, 4}, 0.5}}));
    gas.fill({4, 5}, 0.9);
    EXPECT_EQ(gas.targetsOf({4, 4}).size(), 3U);
  }
}

TEST(SmallCells, BetweenEqualNeighboursKeepTheMirrorSymmetryOfTheGas) {
  Sharing<1> gas(7);
  gas.fill({3}, 0.25, 3);
  gas.share();
  const auto& density = gas.after.density.values;
  const double half = (1 + 0.125 * 3) / 1.125;  // of one neighbour with a half of the cell
  for (const std::size_t cell : {2, 4}) EXPECT_DOUBLE_EQ(density[cell], half);
  EXPECT_DOUBLE_EQ(density[3], 0.25 * half);
  EXPECT_EQ(gas.merged.total(), 1);
}

TEST(SmallCells, ThatAreClosedConnectNoNeighbours) {
  Sharing<1> gas(7);
  gas.fill({3}, 0.3);
  for (const int face : {3, 4}) gas.before.coverage.cells()[Index<1>{face}] = Vec<1>(1);
  EXPECT_EQ(gas.targetOf({3}), Index<1>{2});
  gas.before.free.cells()[Index<1>{3}] = 0;  // it gets nothing back
  EXPECT_EQ(gas.targetsOf({3}).size(), 2U);
}

TEST(SmallCells, KeepThePartForANeighbourThatGivesAwayItsOwn) {
  Sharing<1> gas(7);
  gas.fill({1}, 0);
  gas.fill({2}, 0.4);
  gas.fill({3}, 0.3, 3);
  gas.fill({4}, 0.4);
  EXPECT_EQ(gas.targetsOf({3}), (Sharing<1>::Targets{{{2}, 0.5}, {{3}, 0.5}}));
  EXPECT_EQ(gas.targetOf({4}), Index<1>{5});
  gas.share();
  EXPECT_DOUBLE_EQ(sumOf(gas.after.density.values), sumOf(gas.before.density.values));
  EXPECT_DOUBLE_EQ(gas.after.density.values[3], 0.5 * 0.9 + 0.15 * (0.4 + 0.45) / 0.55);
}

TEST(SmallCells, OfEqualSizeKeepTheirGas) {
  for (const double roundOff : {-1e-12, 0.0, 1e-12}) {
    Sharing<1> gas(7);
    for (int cell = 0; cell < 7; ++cell) gas.fill({cell}, 0.3 + (cell == 3 ? roundOff : 0));
    for (int cell = 0; cell < 7; ++cell) EXPECT_EQ(gas.targetOf({cell}), Index<1>{cell});
  }
}

TEST(SmallCells, WithWorkThatAWallLeavesGiveIt) {
  Sharing<1> gas(6);
  gas.fill({3}, 0);
  gas.before.energy.cells()[Index<1>{3}] = 0.1;
  gas.share();
  EXPECT_EQ(gas.after.energy.cells()[Index<1>{3}], 0);
  EXPECT_DOUBLE_EQ(sumOf(gas.after.energy.values), 5 * 2.5 + 0.1);
}

TEST(SmallCells, GiveTheirGasToTheNeighbourWithTheWidestWay) {
  Sharing<1> gas(8);
  gas.fill({2}, 0.3);
  gas.fill({3}, 0);
  gas.fill({4}, 0);
  gas.fill({5}, 0.4);
  EXPECT_EQ(gas.targetOf({2}), Index<1>{1});
  EXPECT_EQ(gas.targetOf({5}), Index<1>{6});
  EXPECT_EQ(gas.targetOf({1}), Index<1>{1});
  EXPECT_EQ(gas.targetOf({3}), Index<1>{3});
  gas.share();
  EXPECT_EQ(gas.merged.total(), 2);
  gas.fill({3}, 0.6);
  gas.fill({4}, 1);
  gas.fill({1}, 0.6);
  EXPECT_EQ(gas.targetsOf({2}).size(), 2U);
  gas.before.coverage.cells()[Index<1>{2}] = Vec<1>(0.5);  // now the way there is narrower
  EXPECT_EQ(gas.targetOf({2}), Index<1>{3});
}

TEST(SmallCells, GiveAcrossACornerWhereThereIsNoOtherRoom) {
  Sharing<2> gas(5);
  forEach<2>(gas.box(), [&](const Index<2>& cell) { gas.fill(cell, 0); });
  gas.fill({2, 2}, 0.1);
  gas.fill({3, 3}, 0.9);
  EXPECT_EQ(gas.targetOf({2, 2}), (Index<2>{3, 3}));
  gas.fill({1, 2}, 0.6);  // across a face it is nearer
  EXPECT_EQ(gas.targetOf({2, 2}), (Index<2>{1, 2}));
}

TEST(SmallCells, ThatGiveTakeNothing) {
  Sharing<1> gas(6);
  gas.fill({3}, 0.3);
  gas.fill({4}, 0.2);
  gas.fill({5}, 0);
  EXPECT_EQ(gas.targetOf({3}), Index<1>{2});
  EXPECT_EQ(gas.targetOf({4}), Index<1>{4});
}

TEST(SmallCells, WithoutAWayOutAreHoles) {
  Sharing<1> gas(7);
  for (int cell = 2; cell < 6; ++cell) gas.fill({cell}, 0);
  gas.fill({4}, 0.1);
  gas.share();
  EXPECT_EQ(gas.after.free.values[4], 0);
  EXPECT_EQ(gas.after.free.values[1], 1);
  EXPECT_DOUBLE_EQ(gas.after.density.values[4], 0.1) << "what it holds waits";
}

TEST(SmallCells, ShareByVolume) {
  Sharing<1> gas(6);
  gas.fill({2}, 0.25, 3);
  gas.fill({3}, 0);
  gas.share();
  for (const int cell : {1, 2})
    EXPECT_DOUBLE_EQ(gas.after.density.values[cell] / gas.after.free.values[cell], 1.75 / 1.25);
  EXPECT_EQ(gas.after.density.values[0], 1);
  EXPECT_EQ(gas.after.density.values[4], 1);
}

TEST(SmallCells, AreCountedIfTheyHaveFreeVolume) {
  for (const double free : {0.0, 0.25}) {
    Sharing<1> gas(6);
    gas.fill({2}, free);
    gas.before.density.cells()[Index<1>{2}] += 1e-34;  // round-off
    gas.share();
    EXPECT_EQ(gas.merged.value, free > 0 ? 1 : 0);
    EXPECT_EQ(gas.targetsOf({2}).front().first, Index<1>{1}) << "round-off is given away, too";
  }
}

TYPED_TEST(SmallCellsAlongAxes, KeepMassMomentumAndEnergy) {
  constexpr int D = TypeParam::value;
  Sharing<D> gas(D == 1 ? 200 : D == 2 ? 20 : 8);
  int number = 0;
  forEach<D>(gas.box(), [&](const Index<D>& cell) {
    const double seed = wild(++number);
    gas.fill(cell, seed < 0.2 ? 0 : seed < 0.5 ? 1 : wild(3 * number), 0.5 + wild(5 * number));
    for (int d = 0; d < D; ++d) gas.before.momentum.cells()[cell][d] = 0.1 * gas.before.density.seen()[cell] * seed;
    for (int d = 0; d < D; ++d) gas.before.coverage.cells()[cell][d] = wild(7 * number + d);
  });
  gas.share();
  EXPECT_NE(gas.after.density.values, gas.before.density.values);
  EXPECT_NEAR(sumOf(gas.after.density.values) / sumOf(gas.before.density.values), 1, 1e-13);
  EXPECT_NEAR(sumOf(gas.after.energy.values) / sumOf(gas.before.energy.values), 1, 1e-13);
  Vec<D> momentum = Vec<D>::Zero();
  for (std::size_t k = 0; k < gas.before.momentum.values.size(); ++k)
    momentum += gas.after.momentum.values[k] - gas.before.momentum.values[k];
  EXPECT_NEAR(momentum.norm(), 0, 1e-13);
}

}  // namespace tushar::mpmice
