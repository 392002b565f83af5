#include <algorithm>

#include "core/tasks/scheduler.hpp"

// Which materials have no particles, so that tasks need not run for them.

namespace tushar::tasks {

using data::Generation;

/// Finds the materials that have particles on any rank at the start of a graph.
void Scheduler::findAbsent(const TaskGraph& graph) {
  skips_ = may_skip_;
  for (const CompiledTask& task : graph.tasks()) skips_ = skips_ && task.task.kind != TaskKind::newParticles;
  if (!skips_) return;
  is_present_.assign(static_cast<std::size_t>(graph.materials()), 0);
  for (int m = 0; m < graph.materials(); ++m)
    for (const grid::Patch& patch : warehouse_->grid().patches())
      if (warehouse_->particles(Generation::old, m, patch.id()).owned() > 0) is_present_[m] = 1;
  if (!warehouse_->ranks().isAlone()) {
    std::vector<double> onAny(is_present_.begin(), is_present_.end());
    warehouse_->ranks().max(onAny);
    for (std::size_t m = 0; m < onAny.size(); ++m) is_present_[m] = onAny[m] > 0;
  }
  first_absent_ = static_cast<int>(std::find(is_present_.begin(), is_present_.end(), 0) - is_present_.begin());
}

TaskContext Scheduler::contextOf(const CompiledTask& task, const grid::Patch& patch, int material, const StepInfo& at) {
  const int shown = isPresent(material) ? material : first_absent_;
  return {*warehouse_, patch, shown, task.of(shown).accesses, at.time};
}

std::span<const BoundGhostFill> Scheduler::presentOf(const std::vector<BoundGhostFill>& fills) {
  if (!skips_) return fills;
  present_fills_.clear();
  for (const BoundGhostFill& fill : fills)
    if (isPresent(warehouse_->table()[fill.variable].material)) present_fills_.push_back(fill);
  return present_fills_;
}

}  // namespace tushar::tasks
