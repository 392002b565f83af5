#include <cstring>

#include "core/tasks/kept_levels.hpp"
#include "core/tasks/scheduler.hpp"

// Graphs that are run on one level after the other.

namespace tushar::tasks {

using data::Generation;

bool Scheduler::isOfLevel(std::size_t place) const {
  return level_ < 0 || warehouse_->grid().patches()[place].level().number() == level_;
}

void Scheduler::commitLevel(const TaskGraph& graph, int level) {
  const std::vector<grid::Patch>& patches = warehouse_->grid().patches();
  for (const int number : graph.results())
    if (!isHeld(*warehouse_, Generation::old, number)) warehouse_->allocateGrid(Generation::old, number);
  const auto copy = [&](int place) {
    const grid::Patch& patch = patches[static_cast<std::size_t>(place)];
    if (patch.level().number() != level) return;
    for (const int number : graph.results()) {
      const std::span<std::byte> values = valuesOn(*warehouse_, Generation::fresh, number, patch);
      std::memcpy(valuesOn(*warehouse_, Generation::old, number, patch).data(), values.data(), values.size());
    }
  };
  threads_.forEach(static_cast<int>(patches.size()), copy);
}

void Scheduler::forgetNew(const TaskGraph& graph) {
  for (const CompiledTask& task : graph.tasks())
    for (const MaterialBinding& binding : task.materials)
      for (const Output& output : binding.outputs)
        if (isHeld(*warehouse_, Generation::fresh, output.variable))
          warehouse_->free(Generation::fresh, output.variable);
}

}  // namespace tushar::tasks
