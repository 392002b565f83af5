#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "core/simulation/phases.hpp"

namespace tushar::simulation {

void Phases::printSchedule(std::ostream& out) const {
  for (const tasks::TaskGraph* graph : {&initialize, &stableTimeStep, &timeAdvance}) {
    graph->print(out);
    graph->printLeftOut(out);
  }
  if (!refluxing.tasks().empty()) {
    out << "each level runs computeStableTimeStep and timeAdvance separately, with about two steps for each step\n"
           "of the next coarser level, which then runs:\n";
    refluxing.print(out);
  }
  for (const tasks::TaskGraph* graph : {&everyStep, &everyOutput, &report, &refinement, &refined})
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
