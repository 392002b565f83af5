#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "core/simulation/phases.hpp"

namespace tushar::simulation {

namespace {

bool usesParticles(const tasks::TaskGraph& graph) {
  return std::ranges::any_of(graph.tasks(), [](const tasks::CompiledTask& task) {
    return std::ranges::any_of(task.task.accesses, [](const tasks::Access& access) {
      return access.label->centring == data::Centring::particle;
    });
  });
}

}  // namespace

/// What runs on which level, if there are several.
void Phases::printLevels(std::ostream& out) const {
  if (levels_ == 1) return;
  if (!smaller_steps_) {
    out << fmt::format("each task runs on the patches of all {} levels, with the same time step\n", levels_);
    if (usesParticles(timeAdvance))
      out << fmt::format("particles are on level {}, the finest; on coarser levels, tasks find none\n", levels_ - 1);
    return;
  }
  out << "each level runs computeStableTimeStep and timeAdvance separately, with about two steps for each step\n"
         "of the next coarser level";
  if (!refluxing.tasks().empty()) out << ", which then runs:";
  out << '\n';
  if (!refluxing.tasks().empty()) refluxing.print(out);
}

void Phases::printSchedule(std::ostream& out) const {
  for (const tasks::TaskGraph* graph : {&initialize, &stableTimeStep, &timeAdvance, &nextMaterials}) {
    if (graph == &nextMaterials && nextMaterials.tasks().empty()) continue;
    graph->print(out);
    graph->printLeftOut(out);
  }
  printLevels(out);
  for (const tasks::TaskGraph* graph : {&afterStep, &everyStep, &everyOutput, &report, &refinement, &refined})
    if (!graph->tasks().empty()) graph->print(out);
  out << "diagnostics that are never run\n";
  for (const tasks::LeftOut& task : everyStep.leftOut()) {
    const auto leavesOut = [&](const tasks::TaskGraph& graph) {
      return std::any_of(graph.leftOut().begin(), graph.leftOut().end(),
                         [&](const tasks::LeftOut& other) { return other.task == task.task; });
    };
    const bool isForRefinement = !refinement.tasks().empty() && !leavesOut(refinement);
    if (leavesOut(everyOutput) && leavesOut(report) && !isForRefinement)
      out << fmt::format("  --  {} left out: {}\n", task.task, task.reason);
  }
}

void Phases::printDot(std::ostream& out) const { timeAdvance.printDot(out); }

}  // namespace tushar::simulation
