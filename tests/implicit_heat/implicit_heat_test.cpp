#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "components/implicit_heat/implicit_heat.hpp"
#include "tests/support/run.hpp"

// Heat conduction with a global solve in each step.

namespace tushar::implicit_heat {

namespace {

grid::Domain slab(int cells) {
  grid::Domain domain;
  domain.upper = {1, 0, 0};
  domain.resolution = {{cells, 1, 1}};
  domain.patches = {{2, 1, 1}};
  return domain;
}

void keep(grid::Domain& domain, int side, double temperature) {
  domain.boundaries.face(0, side).push_back({boundary::temperature, BoundaryKind::dirichlet, Vec3(temperature, 0, 0)});
}

Settings implicitSettings(double theta, const char* temperature, const char* conductivity = "1") {
  Settings settings;
  settings.theta = theta;
  settings.solver = {"preonly", "lu", 1e-10, 1, ""};
  settings.temperature = *input::Expression::parse(temperature);
  settings.conductivity = *input::Expression::parse(conductivity);
  return settings;
}

/// T in the cells after `steps` steps of `dt`.
std::vector<double> after(const grid::Domain& domain, const Settings& settings, double dt, int steps) {
  test::Runner run(domain);
  const ImplicitHeat<1> heat(settings);
  TaskList start, advance;
  heat.scheduleInitialize(start);
  heat.scheduleTimeAdvance(advance);
  tasks::TaskGraph begin = run.compile(start, {"c.temperature"}), step = run.compile(advance, {"c.temperature"}, true);
  run.warehouse.grow(0);
  run.warehouse.reduction<Minimum>(run.table.number(delT, -1)).value = dt;
  run.step(begin);
  for (int k = 0; k < steps; ++k) run.step(step);
  std::vector<double> temperature;
  for (const Patch& patch : run.grid.patches()) {
    const auto held = run.warehouse.variable(data::Generation::old, run.table.find("c.temperature", -1), patch.id());
    const auto* values = reinterpret_cast<const double*>(held.values);
    forEach<3>(patch.cells(), [&](const Index3& cell) { temperature.push_back(values[held.stored.offset(cell)]); });
  }
  return temperature;
}

/// Error in time alone of the first sine between cold faces at t = 0.1, against the system of equations in the cells:
/// its rate of decay is 4/h² sin²(pi h / 2).
double errorInTime(double theta, int steps) {
  const int cells = 16;
  grid::Domain domain = slab(cells);
  keep(domain, 0, 0);
  keep(domain, 1, 0);
  const double rate = 4.0 * cells * cells * std::pow(std::sin(M_PI / 2 / cells), 2);
  const std::vector<double> temperature = after(domain, implicitSettings(theta, "sin(pi*x)"), 0.1 / steps, steps);
  double error = 0;
  for (int k = 0; k < cells; ++k)
    error = std::max(
        error, std::abs(temperature[std::size_t(k)] - std::exp(-0.1 * rate) * std::sin(M_PI * (k + 0.5) / cells)));
  return error;
}

/// A slab between 1 K and 2 K, one half of which conducts a million times better; it starts with a spike.
constexpr const char* jump = "x < 0.5 ? 1 : 1e6";
constexpr const char* spike = "x < 0.1 ? 1000 : 0.001";
grid::Domain betweenOneAndTwo() {
  grid::Domain domain = slab(32);
  keep(domain, 0, 1);
  keep(domain, 1, 2);
  return domain;
}
/// 1e4 times the stable step of the explicit scheme with k = 1e6.
double longStep() { return 1e4 * 0.5 / (32 * 32) / 1e6; }

}  // namespace

TEST(ImplicitHeat, IsOfFirstOrderInTimeByBackwardEuler) {
  EXPECT_NEAR(std::log2(errorInTime(1, 20) / errorInTime(1, 40)), 1, 0.05);
}

TEST(ImplicitHeat, IsOfSecondOrderInTimeByCrankNicolson) {
  EXPECT_NEAR(std::log2(errorInTime(0.5, 10) / errorInTime(0.5, 20)), 2, 0.05);
}

TEST(ImplicitHeat, StaysWithinTheRangeOfTheStartAndTheFacesWithLongSteps) {
  for (const int steps : {1, 2, 10}) {
    const std::vector<double> temperature =
        after(betweenOneAndTwo(), implicitSettings(1, spike, jump), longStep(), steps);
    EXPECT_GT(*std::min_element(temperature.begin(), temperature.end()), 0.001);
    EXPECT_LT(*std::max_element(temperature.begin(), temperature.end()), 1000);
  }
}

TEST(ImplicitHeat, ReachesTheSteadyStateOfTwoConductivities) {
  const std::vector<double> temperature =
      after(betweenOneAndTwo(), implicitSettings(1, spike, jump), 1e4 * longStep(), 40);
  // The flux is the same everywhere: nearly all of the temperature difference is in the half that conducts badly.
  const double flux = 1 / (0.5 + 0.5e-6);
  for (int k = 0; k < 32; ++k) {
    const double x = (k + 0.5) / 32, exact = x < 0.5 ? 1 + flux * x : 2 - flux * 1e-6 * (1 - x);
    // The influence of the initial state decays by a factor of 1 + rate dt > 1 + 4 * 49 in each step; the rest is
    // rounding times 1e6.
    EXPECT_NEAR(temperature[std::size_t(k)], exact, 1e-8) << k;
  }
}

TEST(ImplicitHeat, ComesToTheSameByMultigridAsByElimination) {
  Settings settings = implicitSettings(1, spike, jump);
  const std::vector<double> direct = after(betweenOneAndTwo(), settings, longStep(), 3);
  settings.solver = {"cg", "gamg", 1e-12, 1000, ""};
  const std::vector<double> iterated = after(betweenOneAndTwo(), settings, longStep(), 3);
  for (std::size_t k = 0; k < direct.size(); ++k) EXPECT_NEAR(iterated[k], direct[k], 1e-6 * direct[k]);
}

TEST(ImplicitHeat, KeepsItsHeatInAnInsulatedBox) {
  const std::vector<double> temperature = after(slab(8), implicitSettings(0.5, "x"), 3.0, 2);
  double sum = 0;
  for (const double value : temperature) sum += value;
  EXPECT_NEAR(sum, 8 * 0.5, 1e-12);
}

}  // namespace tushar::implicit_heat
