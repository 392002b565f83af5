#include <gtest/gtest.h>

#include "components/components.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"

// The module exactSolution: what it can measure, and in which unit.

namespace tushar::analysis {

using simulation::Problem;
using simulation::RunOptions;
using simulation::Simulation;

namespace {

/// Returns the error of a variable of the shock-bubble scene after a step of 1 ns, compared with a formula.
report::ErrorNorms errorOf(const std::string& label, const std::string& formula,
                           const std::vector<std::string>& more = {}) {
  const std::string module = "DataAnalysis/Module/";
  std::vector<std::string> overrides{
      "Time/max_Timesteps=1",         "Time/delt_max=1e-9",      "Grid/Level/Box/resolution=[20,10,1]",
      module + "@name=exactSolution", module + "label=" + label, module + "value=" + formula};
  overrides.insert(overrides.end(), more.begin(), more.end());
  Problem problem = scene::readScene("ups/euler/shock_bubble.ups", overrides, catalogue());
  problem.archive.saves.clear();
  RunOptions options;
  options.quiet = true;
  return Simulation(std::move(problem), options, std::chrono::steady_clock::now()).run().errors.back();
}

}  // namespace

TEST(ExactSolution, MeasuresTheStateAndWhatDiagnosticsComputeOfIt) {
  const report::ErrorNorms density = errorOf("c.density", "0"), pressure = errorOf("c.pressure", "0");

  EXPECT_NEAR(density.norms.at("max"), 3.8125, 1e-6);
  EXPECT_NEAR(pressure.norms.at("max"), 10, 1e-6);
}

TEST(ExactSolution, MeasuresAComponentOfAVector) {
  const auto speed = [](const std::string& axis) {
    return errorOf("c.velocity", "0", {"DataAnalysis/Module/component=" + axis});
  };
  EXPECT_NEAR(speed("x").norms.at("max"), 2.576693, 1e-6);
  EXPECT_EQ(speed("y").norms.at("max"), 0);
  EXPECT_EQ(speed("z").norms.at("max"), 0);
  EXPECT_EQ(speed("x").field, "velocity.x");
}

TEST(ExactSolution, AsksForTheComponentOfAVector) {
  try {
    errorOf("c.velocity", "0");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().at(0).sentence, "'c.velocity' is a vector: give its <component>, x, y or z");
  }
}

TEST(ExactSolution, HasTheUnitOfWhatItMeasures) {
  EXPECT_EQ(errorOf("c.density", "0").unit, "kg/m^3");
  EXPECT_EQ(errorOf("c.pressure", "0").unit, "Pa");
}

}  // namespace tushar::analysis
