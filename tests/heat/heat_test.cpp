#include "components/heat/heat.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/run.hpp"

namespace tushar::heat {

namespace {

/// A domain of unit length along its first D axes, whose faces have temperature 0 or are insulated.
template <int D>
grid::Domain slab(int cells, bool cold) {
  grid::Domain domain = test::unitBox<D>(cells);
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (cold) domain.boundaries.face(d, side).push_back({boundary::temperature, BoundaryKind::dirichlet});
  return domain;
}

/// Mean of |T - exact| at time 0.02 for a product of sines that decays.
template <int D>
double errorOfSine(int cells) {
  test::Runner run(slab<D>(cells, true));
  Settings settings;
  settings.temperature = *input::Expression::parse(D == 1   ? "sin(pi*x)"
                                                   : D == 2 ? "sin(pi*x)*sin(pi*y)"
                                                            : "sin(pi*x)*sin(pi*y)*sin(pi*z)");
  const Heat<D> heat(settings);
  TaskList start, advance;
  heat.scheduleInitialize(start);
  heat.scheduleTimeAdvance(advance);
  tasks::TaskGraph begin = run.compile(start, {"c.temperature"}), step = run.compile(advance, {"c.temperature"}, true);
  const double end = 0.02;
  const int steps = D * cells * cells / 2;  // dt as h², far from h²/6a, where the errors in time and space cancel
  run.warehouse.grow(0);
  run.warehouse.reduction<Minimum>(run.table.number(delT, -1)).value = end / steps;
  run.step(begin);
  for (int k = 0; k < steps; ++k) run.step(step);
  Norm error;
  for (const Patch& patch : run.grid.patches()) {
    const auto held = run.warehouse.variable(data::Generation::old, run.table.find("c.temperature", -1), patch.id());
    const auto* values = reinterpret_cast<const double*>(held.values);
    forEach<3>(patch.cells(), [&](const Index3& cell) {
      double exact = std::exp(-D * M_PI * M_PI * end);
      for (int d = 0; d < D; ++d) exact *= std::sin(M_PI * (cell[d] + 0.5) / cells);
      error.add(values[held.stored.offset(cell)] - exact);
    });
  }
  return error.l1();
}

/// Returns T after a step of `dt` in one dimension, computed on plain arrays.
std::vector<double> conducted(const grid::Domain& domain, std::vector<double> temperature, double dt) {
  const Grid grid(domain);
  const Level& level = grid.level();
  std::vector<double> after(temperature.size());
  conduct<1>(grid.patches().front(), Settings(), CellView<const double>(temperature.data(), level.cells()), dt,
             CellView<double>(after.data(), level.cells()));
  return after;
}

}  // namespace

TEST(Heat, IsOfSecondOrderInSpaceOnASine) {
  for (const auto& [coarse, fine] : {std::pair{errorOfSine<1>(16), errorOfSine<1>(32)},
                                     {errorOfSine<2>(12), errorOfSine<2>(24)},
                                     {errorOfSine<3>(8), errorOfSine<3>(16)}}) {
    const double order = std::log2(coarse / fine);
    EXPECT_GT(order, 1.9);
    EXPECT_LT(order, 2.1);
  }
}

TEST(Heat, KeepsItsHeatInAnInsulatedBox) {
  grid::Domain domain = slab<1>(4, false);
  domain.patches = {{1, 1, 1}};

  const std::vector<double> after = conducted(domain, {1, 5, 2, 8}, 0.01);

  EXPECT_NEAR(after[0] + after[1] + after[2] + after[3], 16, 1e-14);
}

TEST(Heat, MovesATemperatureByTheDifferenceOfItsNeighbours) {
  grid::Domain domain = slab<1>(4, true);
  domain.patches = {{1, 1, 1}};

  const std::vector<double> after = conducted(domain, {1, 5, 2, 8}, 0.01);

  EXPECT_NEAR(after[1], 5 + 0.01 * 16 * (1 - 10 + 2), 1e-14);
  EXPECT_NEAR(after[0], 1 + 0.01 * 16 * (-1 - 2 + 5), 1e-14);  // beyond the face -1: the face itself is at 0
}

TEST(Heat, LetsANeumannFaceGiveHeat) {
  grid::Domain domain = slab<1>(4, false);
  domain.patches = {{1, 1, 1}};
  domain.boundaries.face(0, 1).push_back({boundary::temperature, BoundaryKind::neumann, Vec3(3, 0, 0)});

  const std::vector<double> after = conducted(domain, {0, 0, 0, 0}, 0.01);

  EXPECT_NEAR(after[3], 0.01 * 3 / 0.25, 1e-15);  // dt k g / h
  EXPECT_EQ(after[0], 0);
}

TEST(Heat, MarksCellsBesideWhichAStraightLineIsWrong) {
  grid::Domain domain = slab<1>(6, false);
  domain.patches = {{1, 1, 1}};
  const Grid grid(domain);
  const Box& cells = grid.level().cells();
  std::vector<double> temperature{3, 0, 0, 8, 17, 26};  // second differences from the second cell on: 3, 8, 1, 0
  std::vector<int> marks(6, 0);

  estimateError<1>(grid.patches().front(), 0.5, CellView<const double>(temperature.data(), cells),
                   Marks(CellView<int>(marks.data(), cells)));

  EXPECT_EQ(marks, (std::vector<int>{0, 1, 2, 0, 0, 0}));
}

TEST(Heat, LeavesFinerMarksOfOthersAsTheyAre) {
  grid::Domain domain = slab<1>(4, false);
  domain.patches = {{1, 1, 1}};
  const Grid grid(domain);
  const Box& cells = grid.level().cells();
  std::vector<double> temperature{0, 0, 2, 2};
  std::vector<int> marks{0, 2, 0, 1};

  estimateError<1>(grid.patches().front(), 0.5, CellView<const double>(temperature.data(), cells),
                   Marks(CellView<int>(marks.data(), cells)));

  EXPECT_EQ(marks, (std::vector<int>{0, 2, 1, 1}));
}

TEST(Heat, LimitsTheTimeStepByVonNeumann) {
  const Grid grid(slab<2>(10, true));
  Settings settings;
  settings.conductivity = 2;
  Minimum dt;

  computeStableTimeStep<2>(grid.patches().front(), settings, dt);

  EXPECT_NEAR(dt.value, 0.9 * 0.01 / (2 * 2 * 2), 1e-15);
}

}  // namespace tushar::heat
