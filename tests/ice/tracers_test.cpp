#include <gtest/gtest.h>

#include <cmath>

#include "components/ice/tracers/tasks.hpp"
#include "tests/euler/gas_box.hpp"
#include "tests/support/particles.hpp"

// Tracers that move with a gas.

namespace tushar::ice {
namespace {

constexpr double h = 1.0 / 8;

/// The velocity v(x) of the cells of a square.
struct Field {
  explicit Field(const Level& level, const std::function<Vec<2>(const Vec<2>&)>& v) : box(level.cells()) {
    forEach<2>(box, [&](const Index<2>& cell) { values.push_back(v(level.cellCentre<2>(cell))); });
  }
  CellView<const Vec<2>> view() const { return {values.data(), box}; }

  Box box;
  std::vector<Vec<2>> values;
};

struct Square {
  explicit Square(const grid::Domain& domain, const std::function<Vec<2>(const Vec<2>&)>& v, const euler::Gas& gas = {})
      : grid(domain), field(grid.level(), v), flow(grid.patches().front(), gas, 0, field.view()) {}
  Vec<2> at(const Vec<2>& x) const { return flow.at(x, grid.level().cellOf<2>(x)); }

  Grid grid;
  Field field;
  Flow<2> flow;
};

Vec<2> linear(const Vec<2>& x) { return {1 + 2 * x[0] - x[1], 3 * x[1] - x[0]}; }
Vec<2> uniform(const Vec<2>&) { return {0.3, 0.7}; }

TEST(Flow, IsExactIfTheVelocityIsLinear) {
  const Square square(euler::openBox(2, 8), linear);
  for (const Vec<2>& x : {Vec<2>(0.1, 0.2), Vec<2>(0.5, 0.5), Vec<2>(0.93, 0.07)})
    EXPECT_LT((square.at(x) - linear(x)).norm(), 1e-15);
}

TEST(Flow, OfAUniformVelocityIsThatVelocityInEveryBit) {
  const Square square(euler::openBox(2, 8), uniform);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(square.at(placeInCell<2>(k)), uniform({}));
}

TEST(Flow, EndsAtWalls) {
  const Square square(euler::closedBox(2, 8), uniform);
  EXPECT_EQ(square.at({0, 0.4}), Vec<2>(0, 0.7));
  EXPECT_EQ(square.at({1, 0.4}), Vec<2>(0, 0.7));
  EXPECT_EQ(square.at({0, 1}), Vec<2>(0, 0));
  EXPECT_DOUBLE_EQ(square.at({0.25 * h, 0.4})[0], 0.15);
}

TEST(Flow, BeyondAnOpenSideIsThatOfTheNearestCells) {
  const Square square(euler::openBox(2, 8), linear);
  EXPECT_LT((square.at({0, 0.4}) - linear({0.5 * h, 0.4})).norm(), 1e-15);
}

TEST(Flow, OfAViscousGasSticksToWalls) {
  grid::Domain domain = euler::closedBox(2, 8);
  for (const int side : {0, 1})
    domain.boundaries.face(
        1, side) = {{euler::boundary::velocity, BoundaryKind::dirichlet, Vec3(side == 0 ? -1 : 2, 0, 0)}};
  const auto shear = [](const Vec<2>& x) { return Vec<2>(-1 + 3 * x[1], 0); };
  euler::Gas viscous;
  viscous.sticks = true;
  const Square sticks(domain, shear, viscous), slips(domain, shear);
  for (const double y : {0.0, 0.2 * h, 0.4, 1 - 0.3 * h, 1.0})
    EXPECT_LT((sticks.at({0.5, y}) - shear({0.5, y})).norm(), 1e-15) << y;
  EXPECT_DOUBLE_EQ(slips.at({0.5, 0})[0], shear({0, 0.5 * h})[0]) << "a gas without viscosity slips";
}

TEST(Flow, IsReflectedByWallsAlone) {
  const Square closed(euler::closedBox(2, 8), uniform), open(euler::openBox(2, 8), uniform);
  Vec<2> x(-0.01, 1.02), y = x;
  closed.flow.reflect(x, {{0, 7}});
  EXPECT_DOUBLE_EQ(x[0], 0.01);
  EXPECT_DOUBLE_EQ(x[1], 0.98);
  open.flow.reflect(y, {{0, 7}});
  EXPECT_EQ(y, Vec<2>(-0.01, 1.02));
}

/// In a steady flow v = A x, the method is the second-order Taylor polynomial of the exact motion.
TEST(Tracers, MoveAsThePolynomialOfSecondOrder) {
  const double dt = 0.1, w = 0.6;
  const auto turn = [&](const Vec<2>& x) { return Vec<2>(-w * (x[1] - 0.5), w * (x[0] - 0.5)); };
  const Square square(euler::openBox(2, 8), turn);
  test::Particles particles(euler::openBox(2, 8));
  std::vector<Vec<2>> x{{0.4, 0.3}}, v{turn(x[0])}, way{{1, 1}}, newX, newV, newWay;
  tasks::ParticleMaker maker(0);
  maker.add<2>(particles.level.cellOf<2>(x[0]), 7);
  maker.makeSet(particles.set, particles.patch(), 0);
  const MovingTracers<2> moving{particles.read(x),     particles.read(v),     particles.read(way),
                                particles.write(newX), particles.write(newV), particles.write(newWay)};
  moveTracers<2>(square.grid.patches().front(), {"gas"}, {}, 0, dt, square.field.view(), moving);
  const Vec<2> from = x[0] - Vec<2>(0.5, 0.5), across(-from[1], from[0]);
  const Vec<2> exact = x[0] + dt * w * across - 0.5 * dt * dt * w * w * from;
  EXPECT_LT((newX[0] - exact).norm(), 1e-16);
  EXPECT_LT((newV[0] - turn(exact)).norm(), 1e-15);
  EXPECT_LT((newWay[0] - Vec<2>(1, 1) - (exact - x[0])).norm(), 1e-15);
}

template <int D>
void expectEven() {
  for (const int count : {16, 64, 200}) {
    std::vector<int> inPart(1 << D);
    for (int n = 0; n < count; ++n) {
      const Vec<D> place = placeInCell<D>(n);
      int part = 0;
      for (int d = 0; d < D; ++d) {
        EXPECT_GE(place[d], 0);
        EXPECT_LT(place[d], 1);
        part += place[d] < 0.5 ? 0 : 1 << d;
      }
      ++inPart[part];
    }
    for (const int found : inPart) EXPECT_NEAR(found, count >> D, 4) << D << ' ' << count;
  }
  EXPECT_EQ(placeInCell<D>(0), Vec<D>(Vec<D>::Constant(0.5)));
}

TEST(Tracers, FillACellEvenly) {
  expectEven<1>();
  expectEven<2>();
  expectEven<3>();
}

TEST(Tracers, AreMadeAtTheRateWhateverTheSteps) {
  TracerRegion region;
  region.perCellPerTime = 1000;
  TracerSettings settings;
  settings.start = 0.1;
  settings.stop = 0.4;
  for (const double dt : {0.0001, 0.00037, 0.001, 0.07}) {
    std::uint64_t made = 0;
    double time = 0;
    while (time < 0.5) {
      made += madeBy(time + dt, settings, region) - madeBy(time, settings, region);
      time = time + dt * (1 + 1e-16);
    }
    EXPECT_EQ(made, 300U) << dt;
  }
}

}  // namespace
}  // namespace tushar::ice
