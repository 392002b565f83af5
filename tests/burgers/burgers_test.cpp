#include "components/burgers/burgers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "components/components.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"

namespace tushar::burgers {

namespace {

grid::Domain line(int cells) {
  grid::Domain domain;
  domain.upper = Vec3(1, 0, 0);
  domain.resolution = {{cells, 1, 1}};
  return domain;
}

/// Returns u after an Euler step of `dt` in one dimension, computed on plain arrays.
std::vector<double> predicted(const grid::Domain& domain, std::vector<double> u, double dt, const Settings& settings) {
  const Grid grid(domain);
  const Level& level = grid.level();
  std::vector<double> after(u.size());
  predict<1>(grid.patches().front(), settings, CellView<const double>(u.data(), level.cells()), dt,
             CellView<double>(after.data(), level.cells()));
  return after;
}

Settings firstOrder(double viscosity = 0) {
  Settings settings;
  settings.limiter = 0;
  settings.viscosity = viscosity;
  return settings;
}

report::Report run(std::vector<std::string> overrides) {
  simulation::Problem problem = scene::readScene("ups/burgers/sine.ups", overrides, catalogue());
  problem.archive.saves.clear();
  simulation::RunOptions options;
  options.quiet = true;
  return simulation::Simulation(std::move(problem), options, std::chrono::steady_clock::now()).run();
}

/// Returns the order of convergence of the L1 error between 100 and 200 cells.
double order(const std::vector<std::string>& overrides) {
  const auto error = [&](const std::string& cells) {
    std::vector<std::string> all = overrides;
    all.push_back("Grid/Level/Box/resolution=" + cells);
    return run(all).errors.at(0).norms.at("L1");
  };
  return std::log2(error("[100,1,1]") / error("[200,1,1]"));
}

}  // namespace

TEST(Burgers, HasTheFluxOfTheWaveAtTheFace) {
  EXPECT_EQ(godunovFlux(2, 1), 2);  // to the right
  EXPECT_EQ(godunovFlux(1, 2), 0.5);
  EXPECT_EQ(godunovFlux(-2, -1), 0.5);  // to the left
  EXPECT_EQ(godunovFlux(-1, -2), 2);
  EXPECT_EQ(godunovFlux(-1, 2), 0);  // a fan about the face
  EXPECT_EQ(godunovFlux(2, -1), 2);  // shocks
  EXPECT_EQ(godunovFlux(1, -2), 2);
}

TEST(Burgers, ChangesACellByItsFluxes) {
  const std::vector<double> after = predicted(line(4), {1, 2, 1, 1}, 0.01, firstOrder());
  EXPECT_NEAR(after[0], 1, 1e-15);
  EXPECT_NEAR(after[1], 2 - 0.01 * 4 * (2 - 0.5), 1e-15);
  EXPECT_NEAR(after[2], 1 + 0.01 * 4 * (2 - 0.5), 1e-15);
  EXPECT_NEAR(after[3], 1, 1e-15);
}

TEST(Burgers, SmoothsByItsViscosity) {
  const std::vector<double> after = predicted(line(4), {0, 0, 1, 0}, 0.01, firstOrder(0.5));
  EXPECT_NEAR(after[2], 1 - 0.01 * (4 * 0.5 + 0.5 * 16 * 2), 1e-15);
  EXPECT_NEAR(after[1], 0.01 * 0.5 * 16, 1e-15);
  EXPECT_NEAR(after[3], 0.01 * (4 * 0.5 + 0.5 * 16), 1e-15);
}

TEST(Burgers, TakesInWhatAFaceGives) {
  grid::Domain domain = line(4);
  domain.boundaries.face(0, 0).push_back({boundary::velocity, BoundaryKind::dirichlet, Vec3(3, 0, 0)});
  const std::vector<double> after = predicted(domain, {1, 1, 1, 1}, 0.01, firstOrder());
  EXPECT_NEAR(after[0], 1 + 0.01 * 4 * (4.5 - 0.5), 1e-15);
  EXPECT_NEAR(after[1], 1, 1e-15);
}

TEST(Burgers, LimitsTheTimeStepByVelocityAndViscosity) {
  const Grid grid(line(10));
  const Level& level = grid.level();
  const std::vector<double> u{0, 1, -3, 2, 0, 0, 0, 0, 0, 0};
  Settings settings;
  settings.viscosity = 0.1;
  settings.cfl = 0.4;
  Minimum dt;
  computeStableTimeStep<1>(grid.patches().front(), settings, CellView<const double>(u.data(), level.cells()), dt);
  EXPECT_NEAR(dt.value, 0.4 / (3 * 10 + 2 * 0.1 * 100), 1e-15);
}

TEST(BurgersScene, IsOfSecondOrderWhereItIsSmooth) {
  const std::string early = "Time/maxTime=0.2", viscous = "Burgers/viscosity=0.01";
  EXPECT_GT(order({early}), 1.9);
  EXPECT_GT(order({early, viscous}), 1.9);
  EXPECT_GT(order({viscous}), 1.9);
}

TEST(BurgersScene, IsOfFirstOrderAtAShock) {
  EXPECT_GT(order({}), 0.95);
  EXPECT_GT(order({"Burgers/limiter=first_order"}), 0.95);
}

TEST(BurgersScene, KeepsTheIntegralOfU) {
  const report::Drift drift = run({"Burgers/viscosity=0.01"}).drifts.at(0);
  EXPECT_EQ(drift.name, "momentum");
  EXPECT_LT(std::abs(drift.change), 1e-14);
}

TEST(BurgersScene, RunsAlikeAlongEveryAxisOfAPlane) {
  const std::string end = "Time/maxTime=0.1", steps = "Time/delt_max=0.002";
  const auto along = [&](const std::string& cells, const std::string& formula) {
    return run({end, steps, "Grid/Level/Box/resolution=" + cells, "Grid/Level/periodic=[0,0,0]",
                "Burgers/velocity=" + formula, "DataAnalysis/Module/@name=exactSolution",
                "DataAnalysis/Module/label=c.u", "DataAnalysis/Module/value=1"});
  };
  const auto x = along("[40,4,1]", "1 + 0.5*sin(2*pi*x)"), y = along("[4,40,1]", "1 + 0.5*sin(2*pi*y)");
  EXPECT_EQ(x.steps, y.steps);
  EXPECT_NEAR(x.errors.at(0).norms.at("L2"), y.errors.at(0).norms.at("L2"), 1e-14);
}

TEST(BurgersScene, NeedsTheComponentAndOneDimension) {
  const auto problem = [](const std::string& scene, const std::vector<std::string>& overrides) {
    try {
      scene::readScene(scene, overrides, catalogue());
    } catch (const InputError& error) {
      return error.problems().at(0).sentence;
    }
    return std::string("nothing");
  };
  const std::string sentence = "measures the component burgers in one dimension; remove the module";
  EXPECT_EQ(problem("ups/mpm/mass_projection.ups", {"DataAnalysis/Module[@name='massProjection']/@name=burgersWave"}),
            sentence);
  EXPECT_EQ(problem("ups/burgers/sine.ups", {"Grid/Level/Box/resolution=[8,8,1]"}), sentence);
}

}  // namespace tushar::burgers
