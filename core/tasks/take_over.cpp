#include "core/tasks/take_over.hpp"

#include <cstring>
#include <string>

#include "core/tasks/validate.hpp"

namespace tushar::tasks {

namespace {

/// Indices of the accesses of the task: the old values and the new ones.
enum { old, fresh };

void copyCells(const TaskContext& context, std::size_t bytes) {
  const data::Variable from = context.variable(old), to = context.variable(fresh);
  const grid::Box& cells = context.patch().cells();
  const std::size_t length = static_cast<std::size_t>(cells.extent(0)) * bytes;
  grid::forEach<3>(cells.rowStarts(), [&](const Index3& first) {
    std::memcpy(to.values + to.stored.offset(first) * bytes, from.values + from.stored.offset(first) * bytes, length);
  });
}

Task takeOver(const Task& reader, const Access& access) {
  const data::Label& label = *access.label;
  Task task;
  task.name = "take over " + std::string(label.name);
  if (reader.perMaterial(access)) task.materials = reader.materials;
  task.accesses = {{&label, AccessKind::requiresOld}, {&label, AccessKind::computes}};
  task.body = [bytes = label.bytes](const TaskContext& context) { copyCells(context, bytes); };
  return task;
}

}  // namespace

TaskList takingOver(const TaskList& list) {
  TaskList with;
  Names computed;
  for (const Task& task : list.tasks()) {
    for (const Access& access : task.accesses) {
      const bool isNew = access.writes() && computed.emplace(access.label->name).second;
      if (isNew && access.kind == AccessKind::modifies && access.label->centring == data::Centring::cell)
        with.add(takeOver(task, access));
    }
    with.add(task);
  }
  return with;
}

}  // namespace tushar::tasks
