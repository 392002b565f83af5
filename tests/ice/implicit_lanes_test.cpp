#include <gtest/gtest.h>

#include <cmath>

#include "components/ice/tasks/advance_implicitly.hpp"
#include "components/ice/tasks/limit_implicit_step.hpp"
#include "components/ice/tasks/solve_pressure.hpp"
#include "tests/euler/gas_box.hpp"

// Several cells at once have the same bits as one cell after another.

namespace tushar::ice {

namespace {

constexpr int cells = 21;  // not a multiple of what a register holds
constexpr double dt = 0.01;

/// A square with open sides and one wall, with gas that flows in all directions.
struct Square {
  static grid::Domain domain() {
    grid::Domain domain = euler::openBox(2, cells);
    domain.boundaries.face(0, 0).push_back({grid::symmetric, BoundaryKind::symmetry});
    return domain;
  }
  Square() {
    settings.gravity = Vec3(0.3, -0.7, 0);
    settings.soundSpeedKnob = 0.3;
    forEach<2>(box(), [&](const Index<2>& cell) {
      const double x = 0.9 * cell[0], y = 0.7 * cell[1];
      const std::size_t i = level.cellNumber<2>(cell);
      const euler::State<2> u = euler::conserved<2>(
          method.gas, euler::State<2>{1.5 + std::sin(x + y), std::sin(x), std::cos(y), 2 + std::sin(x - y)});
      density[i] = u[0];
      momentum[i] = {u[1], u[2]};
      energy[i] = u[3];
      change[i] = 0.1 * std::sin(2 * x + y);
    });
  }

  const Box& box() const { return level.cells(); }
  template <class T, class Values>
  CellView<const T> seen(const Values& values) const {
    return {values.data(), box(), box()};
  }
  euler::OldState<2> before() const { return {{seen<double>(density), seen<Vec<2>>(momentum), seen<double>(energy)}}; }

  Grid grid{domain()};
  const Level& level = grid.level();
  euler::Settings method;
  IceSettings settings;
  euler::GhostRules<2> rules = euler::ghostRules<2>(level, method.gas);
  std::vector<double> density = std::vector<double>(cells * cells), energy = density, change = density;
  std::vector<Vec<2>> momentum = std::vector<Vec<2>>(cells * cells, Vec<2>::Zero());
};

}  // namespace

TEST(ImplicitLanes, HaveTheFluxesOfSingleFaces) {
  const Square gas;
  const auto change = gas.seen<double>(gas.change);
  // A cell without slopes, in a corner, makes the second step go from cell to cell.
  ImplicitStep<2> lanes(gas.level, gas.method, gas.settings, gas.rules, gas.box(), dt);
  ImplicitStep<2> alone(gas.level, gas.method, gas.settings, gas.rules, gas.box(), dt, [](const Index<2>& cell) {
    return cell == Index<2>{{0, 0}};
  });
  lanes.hold(gas.box(), gas.before(), change);
  alone.hold(gas.box(), gas.before(), change);
  for (int axis = 0; axis < 2; ++axis) {
    Box faces = gas.box();
    ++faces.upper[axis];
    const double most = lanes.computeFluxes(faces, axis);
    EXPECT_GT(most, 0);
    EXPECT_EQ(most, alone.computeFluxes(faces, axis));
    forEach<2>(faces, [&](const Index<2>& face) {
      if (face[0] < 4 && face[1] < 4) return;  // the corner
      for (std::size_t k = 0; k < 4; ++k)
        ASSERT_EQ(lanes.flux().number(face, k), alone.flux().number(face, k))
            << axis << ' ' << face[0] << ' ' << face[1];
    });
  }
}

TEST(ImplicitLanes, HaveTheEquationsOfSingleCells) {
  const Square gas;
  FaceFlow<2> flow(gas.level, gas.method, gas.settings, gas.rules, gas.box(), dt);
  flow.hold(gas.box(), gas.before());
  solvers::BoxSystem system({{cells, cells, 1}, {}});
  const solvers::BoxShape& shape = system.matrix.shape;
  std::array<std::vector<double>, 3>& links = system.matrix.links;
  for (int y = 0; y < cells; ++y) {
    const std::ptrdiff_t at = shape.offset(0, y, 0);
    const solvers::BoxRow<2> row{
        system.matrix.diagonal.data() + at, system.b.data() + at, {links[0].data() + at, links[1].data() + at}};
    fillPressureEquations<2>(flow, Index<2>{{0, y}}, cells, dt, row);
  }
  forEach<2>(gas.box(), [&](const Index<2>& cell) {
    const numerics::CellEquation<2> one = pressureEquation<2>(gas.level, flow, cell, dt);
    const std::ptrdiff_t at = shape.offset(cell[0], cell[1], 0);
    ASSERT_EQ(system.matrix.diagonal[at], one.left.weights[0]);
    ASSERT_EQ(system.b[at], one.right);
    std::array<double, 2> above{};
    for (std::size_t k = 1; k < one.left.count; ++k)
      for (int d = 0; d < 2; ++d)
        if (one.left.cells[k] == cell + Index<2>::unit(d)) above[d] = -one.left.weights[k];
    for (int d = 0; d < 2; ++d) ASSERT_EQ(system.matrix.links[d][at], above[d]) << cell[0] << ' ' << cell[1];
  });
}

TEST(ImplicitLanes, HaveTheRatesOfSingleCells) {
  const Square gas;
  const Box around = gas.box().grown(1, 2);
  GasBefore<2> before(gas.level, gas.method.gas, gas.settings, gas.rules, around.size());
  before.hold(around, gas.before());
  const euler::CrossingRate<2> crossing(gas.method.courant);
  const auto diffusionAt = [](const Index<2>& cell, int axis) { return 0.1 * (cell[0] + cell[1] + axis); };
  const ImplicitRates<2, 1, decltype(diffusionAt)> rates(before, before.old(), 0.3, diffusionAt);
  for (int y = 1; y < cells - 1; ++y) {
    double greatest = 0;
    for (int x = 1; x < cells - 1; ++x) greatest = std::max(greatest, rates.of(Index<2>{{x, y}}).rate(crossing));
    EXPECT_EQ(rates.greatest(Index<2>{{1, y}}, cells - 2, crossing), greatest) << y;
  }
}

}  // namespace tushar::ice
