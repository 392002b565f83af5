#include "core/simulation/level_steps.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/simulation/cooling.hpp"

namespace tushar::simulation {

namespace {

/// A component whose cells get 1 J/s. No step is stable where a cell has more than 1.2 J.
class Warming : public test::Cooling {
 public:
  void scheduleComputeStableTimeStep(TaskList& tasks) const override {
    tasks.perPatch(
        "warming::limit",
        [](const Patch& patch, CellView<const double> heat, Minimum& dt) {
          forEach<1>(patch.cells(), [&](const Index<1>& cell) {
            if (heat[cell] > 1.2) throw NumericalError("too hot", "");
          });
          dt.add(0.25);
        },
        requiresOld(test::heat), computes(delT));
  }
  void scheduleTimeAdvance(TaskList& tasks) const override {
    tasks.perPatch(
        "warming::warm",
        [](const Patch& patch, CellView<const double> before, double dt, CellView<double> after) {
          forEach<1>(patch.cells(), [&](const Index<1>& cell) { after[cell] = before[cell] + dt; });
        },
        requiresOld(test::heat), requiresOld(delT), computes(test::heat));
  }
};

/// Warming on two levels, of which the finer one takes smaller steps.
Problem warming() {
  Problem problem = test::cooling();
  grid::Domain domain;
  domain.upper = {1, 0, 0};
  domain.resolution = {{32, 1, 1}};
  domain.refinement.levels = 2;
  domain.refinement.regions.push_back({1, Vec3(0.25, 0, 0), Vec3(0.5, 0, 0)});
  problem.grid = std::make_unique<Grid>(domain);
  problem.component = std::make_unique<Warming>();
  problem.smallerSteps = Location{};
  return problem;
}

/// The least and the greatest heat of all cells.
std::pair<double, double> rangeOf(RunState& run) {
  std::pair<double, double> range{1e9, -1e9};
  for (const Patch& patch : run.problem.grid->patches()) {
    const data::Variable found =
        run.warehouse.variable(data::Generation::old, run.table.find("c.heat", -1), patch.id());
    forEach<3>(patch.cells(), [&](const Index3& cell) {
      const double heat = reinterpret_cast<const double*>(found.values)[found.stored.offset(cell)];
      range = {std::min(range.first, heat), std::max(range.second, heat)};
    });
  }
  return range;
}

}  // namespace

TEST(LevelSteps, RestoreTheOldStateOfAllLevelsIfTheNewStateAllowsNoStep) {
  test::CoolingRun run(warming());
  run.initialize();
  LevelSteps steps(run);
  EXPECT_EQ(steps.stable().value, 0.25);
  EXPECT_TRUE(steps.advance({.step = 1, .delT = 0.25, .mayRepeat = true}));
  EXPECT_EQ(rangeOf(run), std::pair(1.0, 1.0));
  EXPECT_THROW(steps.advance({.step = 1, .delT = 0.25}), NumericalError);
  EXPECT_EQ(rangeOf(run), std::pair(1.0, 1.0));
  EXPECT_FALSE(steps.advance({.step = 1, .delT = 0.125}));
  EXPECT_EQ(rangeOf(run), std::pair(1.125, 1.125));
}

TEST(LevelSteps, FillACoarserStepByTwoUpToAnEighthBeyondTheLimit) {
  const double stable = 0.1;
  for (const double rest : {0.02, 0.1, 0.1 * (1 + 1e-12)}) EXPECT_EQ(stepsThatFill(rest, stable, true), 1) << rest;
  for (const double rest : {0.11, 0.2, 0.224}) EXPECT_EQ(stepsThatFill(rest, stable, true), 2) << rest;
  for (const double rest : {0.226, 0.337}) EXPECT_EQ(stepsThatFill(rest, stable, true), 3) << rest;
}

TEST(LevelSteps, FillTheRestOfACoarserStepByOneUpToAnEighthBeyondTheLimit) {
  const double stable = 0.1;
  for (const double rest : {0.02, 0.1, 0.112}) EXPECT_EQ(stepsThatFill(rest, stable, false), 1) << rest;
  for (const double rest : {0.114, 0.224}) EXPECT_EQ(stepsThatFill(rest, stable, false), 2) << rest;
}

TEST(LevelSteps, AreOneWhereNothingLimitsThem) {
  EXPECT_EQ(stepsThatFill(0.1, std::numeric_limits<double>::infinity(), true), 1);
}

}  // namespace tushar::simulation
