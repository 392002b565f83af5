#include <fmt/format.h>

#include "core/tasks/scheduler.hpp"

// The end of the run of a graph: errors are recorded, all ranks agree on the first one, and a sentence describes it.

namespace tushar::tasks {

namespace {

/// Calls `visit(slot, position of its bytes)` for each reduction of a graph; returns the total number of bytes.
template <class Visit>
std::size_t forEachReduction(data::Warehouse& warehouse, const TaskGraph& graph, Visit&& visit) {
  std::size_t place = sizeof(Outcome);
  for (const int number : graph.reductions()) {
    data::ReductionSlot& slot = warehouse.slot(number);
    visit(slot, place);
    place += slot.bytes().size();
  }
  return place;
}

}  // namespace

void Scheduler::note(const CompiledTask& task, int material, const NumericalError& error) {
  const auto value = data::Reason::of(error.value().empty() ? task.task.name : error.value());
  const Outcome before = outcome_;
  outcome_.merge({running_, Outcome::Kind::throws, material, error.cell(), warehouse_->ranks().rank(), {}, value});
  if (before.task != outcome_.task || before.kind != outcome_.kind || before.material != outcome_.material)
    error_ = error;
}

void Scheduler::noteBroken(const CompiledTask& task, int first, int end) {
  for (int material = first; material < end; ++material) {
    if (!isPresent(material)) continue;
    const auto& bounded = task.of(material).bounded;
    const std::size_t place = firstThatBreaks(*warehouse_, bounded, level_);
    if (place == bounded.size()) continue;
    const auto value = data::Reason::of(warehouse_->table()[bounded[place].variable].label->name);
    return outcome_.merge({running_, Outcome::Kind::breaks, material, place, warehouse_->ranks().rank(), {}, value});
  }
}

/// Merges the outcome and the reductions of all ranks, in one message to each rank.
void Scheduler::agree(const TaskGraph& graph) {
  if (warehouse_->ranks().isAlone()) return;
  const trace::Span span(trace::Kind::wait, "agree on the outcome");
  mpi::Bytes mine(forEachReduction(*warehouse_, graph, [](auto&, std::size_t) {}));
  std::memcpy(mine.data(), &outcome_, sizeof(Outcome));
  forEachReduction(*warehouse_, graph, [&](data::ReductionSlot& slot, std::size_t place) {
    std::memcpy(mine.data() + place, slot.bytes().data(), slot.bytes().size());
  });
  warehouse_->ranks().merge(mine, [&](const std::byte* from, std::byte* into) {
    mergeInMemory<Outcome>(from, into);
    forEachReduction(*warehouse_, graph,
                     [&](data::ReductionSlot& slot, std::size_t place) { slot.merge(from + place, into + place); });
  });
  std::memcpy(&outcome_, mine.data(), sizeof(Outcome));
  forEachReduction(*warehouse_, graph, [&](data::ReductionSlot& slot, std::size_t place) {
    std::memcpy(slot.bytes().data(), mine.data() + place, slot.bytes().size());
  });
}

/// The error for a violated bound, with values from all ranks as they were after the task. If other ranks have
/// continued since then, the graph is run again up to this task.
NumericalError Scheduler::whatBroke(TaskGraph& graph, const StepInfo& at) {
  const Outcome outcome = outcome_;
  if (!warehouse_->ranks().isAlone()) {
    start(graph, outcome.task + 1, at);
    for (int t = 0; t < end_; ++t) {
      if (t > 0) free(graph.tasks()[t - 1]);
      runTask(graph, t, at);
    }
  }
  const CompiledTask& task = graph.tasks()[outcome.task];
  const auto broken = firstBroken(*warehouse_, task.of(outcome.material).bounded, level_);
  if (!broken)
    throw TaskError(
        fmt::format("{} violated its bound, but not when the task was run again: a body must give the same result each "
                    "time it runs ({})",
                    outcome.value.text(), placeOf(task, -1, outcome.material, at)));
  return {fmt::format("{} ({})", broken->sentence, placeOf(task, broken->patch, outcome.material, at)), "",
          broken->label};
}

}  // namespace tushar::tasks
