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

/// The error of a variable of the shock and the bubble after a step of a nanosecond, against a formula.
report::ErrorNorms errorOf(const std::string& label, const std::string& formula) {
  const std::string module = "DataAnalysis/Module/";
  Problem problem =
      scene::readScene("ups/euler/shock_bubble.ups",
                       {"Time/max_Timesteps=1", "Time/delt_max=1e-9", "Grid/Level/Box/resolution=[20,10,1]",
                        module + "@name=exactSolution", module + "label=" + label, module + "value=" + formula},
                       catalogue());
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

TEST(ExactSolution, HasTheUnitOfWhatItMeasures) {
  EXPECT_EQ(errorOf("c.density", "0").unit, "kg/m^3");
  EXPECT_EQ(errorOf("c.pressure", "0").unit, "Pa");
}

}  // namespace tushar::analysis
