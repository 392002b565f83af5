#include <algorithm>
#include <cstring>

#include "core/tasks/kept_levels.hpp"
#include "core/tasks/scheduler.hpp"

// Graphs that are run on one level after the other.

namespace tushar::tasks {

using data::Generation;

bool Scheduler::isOfLevel(std::size_t place) const {
  return level_ < 0 || warehouse_->grid().patches()[place].level().number() == level_;
}

template <class Work>
void Scheduler::forEachResult(const TaskGraph& graph, int level, const Work& work) {
  const std::vector<grid::Patch>& patches = warehouse_->grid().patches();
  for (const int number : graph.results())
    if (!isHeld(*warehouse_, Generation::old, number)) warehouse_->allocateGrid(Generation::old, number);
  threads_.forEach(static_cast<int>(patches.size()), [&](int place) {
    const grid::Patch& patch = patches[static_cast<std::size_t>(place)];
    if (patch.level().number() != level) return;
    for (const int number : graph.results())
      work(valuesOn(*warehouse_, Generation::fresh, number, patch),
           valuesOn(*warehouse_, Generation::old, number, patch));
  });
}

void Scheduler::commitLevel(const TaskGraph& graph, int level) {
  forEachResult(graph, level, [](std::span<std::byte> fresh, std::span<std::byte> old) {
    std::memcpy(old.data(), fresh.data(), fresh.size());
  });
}

void Scheduler::exchangeLevel(const TaskGraph& graph, int level) {
  forEachResult(graph, level, [](std::span<std::byte> fresh, std::span<std::byte> old) {
    std::swap_ranges(fresh.begin(), fresh.end(), old.begin());
  });
}

void Scheduler::forgetNew(const TaskGraph& graph) {
  for (const CompiledTask& task : graph.tasks())
    for (const MaterialBinding& binding : task.materials)
      for (const Output& output : binding.outputs)
        if (isHeld(*warehouse_, Generation::fresh, output.variable))
          warehouse_->free(Generation::fresh, output.variable);
}

}  // namespace tushar::tasks
