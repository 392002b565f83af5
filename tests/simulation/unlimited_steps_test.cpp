#include <gtest/gtest.h>

#include <map>

#include "components/components.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"

// A component without a limit on its time step adds no task for it: the steps are those of <Time>.

namespace tushar::simulation {

namespace {

/// A component without its time step limit.
class Unlimited : public Component {
 public:
  explicit Unlimited(std::unique_ptr<Component> limited) : limited_(std::move(limited)) {}

  void scheduleInitialize(tasks::TaskList& tasks) const override { limited_->scheduleInitialize(tasks); }
  void scheduleTimeAdvance(tasks::TaskList& tasks) const override { limited_->scheduleTimeAdvance(tasks); }

 private:
  std::unique_ptr<Component> limited_;
};

report::Report run(const std::vector<std::string>& overrides) {
  Problem problem = scene::readScene("ups/heat/sine.ups", overrides, catalogue());
  problem.component = std::make_unique<Unlimited>(std::move(problem.component));
  problem.archive.saves.clear();
  problem.analyses.clear();
  RunOptions options;
  options.quiet = true;
  return Simulation(std::move(problem), options, std::chrono::steady_clock::now()).run();
}

}  // namespace

TEST(UnlimitedSteps, AreThoseOfTheScene) {
  const report::Report report = run({"Time/delt_init=1e-5", "Time/delt_max=1e-4", "Time/maxTime=1e-3"});

  const std::map<std::string, int> limits(report.limits.begin(), report.limits.end());
  EXPECT_EQ(limits, (std::map<std::string, int>{{"delt_init", 1}, {"delt_max", 9}, {"end_at_max_time_exactly", 1}}));
  EXPECT_EQ(report.time, 1e-3);
}

TEST(UnlimitedSteps, TakeOneToTheEndIfTheSceneHasNoLimit) {
  const report::Report report = run({"Time/maxTime=1e-3"});

  EXPECT_EQ(report.steps, 1);
  EXPECT_EQ(report.time, 1e-3);
}

}  // namespace tushar::simulation
