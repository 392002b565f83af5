#pragma once

#include <limits>
#include <memory>
#include <string>

#include "core/core.hpp"
#include "core/simulation/run_state.hpp"
#include "tests/support/levels.hpp"

namespace tushar::test {

inline constexpr CellLabel<double> heat{"c.heat", "J", "heat of a cell"};
inline constexpr ReductionLabel<Sum> totalHeat{"TotalEnergy", "J", "heat of all cells"};

/// A component whose cells start with 1 J and lose half of it in each step.
class Cooling : public Component {
 public:
  void scheduleInitialize(TaskList& tasks) const override {
    tasks.perPatch(
        "cooling::warm",
        [](const Patch& patch, CellView<double> warm) {
          forEach<1>(patch.cells(), [&](const Index<1>& cell) { warm[cell] = 1; });
        },
        computes(heat));
  }
  void scheduleComputeStableTimeStep(TaskList& tasks) const override {
    tasks.perPatch(
        "cooling::limit", [](const Patch&, Minimum& dt) { dt.add(0.25); }, computes(delT));
  }
  void scheduleTimeAdvance(TaskList& tasks) const override {
    tasks.perPatch(
        "cooling::cool",
        [](const Patch& patch, CellView<const double> before, CellView<double> after) {
          forEach<1>(patch.cells(), [&](const Index<1>& cell) { after[cell] = before[cell] / 2; });
        },
        requiresOld(heat), computes(heat));
  }
  void scheduleDiagnostics(TaskList& tasks) const override {
    tasks.perPatch(
        "cooling::sum",
        [](const Patch& patch, CellView<const double> of, Sum& total) {
          forEach<1>(patch.cells(), [&](const Index<1>& cell) { total.add(of[cell]); });
        },
        requiresOld(heat), computes(totalHeat));
  }
};

/// Eight cells on two patches that cool down until 1 s, without outputs.
inline simulation::Problem cooling() {
  simulation::Problem problem;
  problem.scenePath = "cooling.ups";
  problem.componentName = "cooling";
  problem.inputXml = "<Uintah_specification/>\n";
  problem.time.maxTime = 1;
  problem.archive.filebase = "cooling.uda";
  problem.grid = std::make_unique<Grid>(domain({{8, 1, 1}}, {{2, 1, 1}}));
  problem.component = std::make_unique<Cooling>();
  return problem;
}

/// A run without a time loop: the test initialises it and calls each step.
class CoolingRun : public simulation::RunState {
 public:
  explicit CoolingRun(simulation::Problem given = cooling())
      : RunState(std::move(given), {{}, {}, true}, simulation::Clock::now(), mpi::Communicator::alone()) {}

  void initialize() {
    scheduler.run(phases.initialize, {0, 0});
    scheduler.commit(phases.initialize);
    totalsAtStart = measureTotals(phases.startTotals);
  }
  void step() {
    warehouse.beginStep();
    scheduler.run(phases.stableTimeStep, {time.step() + 1, time.time()});
    auto& dt = warehouse.reduction<Minimum>(delT);
    dt.value = time.next(dt, std::numeric_limits<double>::infinity());
    scheduler.run(phases.timeAdvance, {time.step() + 1, time.time(), dt.value});
    scheduler.commit(phases.timeAdvance);
    time.advance();
  }
};

}  // namespace tushar::test
