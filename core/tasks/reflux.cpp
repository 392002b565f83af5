#include "core/tasks/reflux.hpp"

#include <map>
#include <set>

#include "core/data/rim_flux.hpp"

namespace tushar::tasks {

namespace {

/// Accesses of the task: the fluxes, the variable, the time step.
enum { fluxes, variable, timeStep };

void reflux(const TaskContext& context, int components) {
  const grid::Patch& patch = context.patch();
  const data::Variable rim = context.variable(fluxes), cells = context.variable(variable);
  const double dt = context.reduction<data::Minimum>(timeStep).value;
  for (const grid::RimPiece& piece : context.rims()) {
    if (!piece.isFiner) continue;
    const double ratio = (piece.side == 0 ? -dt : dt) / patch.level().spacing(piece.axis);
    const auto* own = reinterpret_cast<const double*>(rim.values) + piece.first * static_cast<std::size_t>(components);
    const double* finer = own + piece.cells.size() * static_cast<std::size_t>(components);
    auto* values = reinterpret_cast<double*>(cells.values);
    grid::forEach<3>(piece.cells, [&](const Index3& cell) {
      double* value = values + cells.stored.offset(cell) * static_cast<std::size_t>(components);
      for (int k = 0; k < components; ++k) value[k] += ratio * (*own++ - *finer++);
    });
  }
}

/// `materials`: those that have the variable; none if it belongs to none.
Task refluxTask(const data::Label& label, const std::vector<std::string>& materials) {
  Task task;
  task.name = "reflux " + std::string(label.name);
  task.materials = materials;
  task.accesses = {{&data::rimLabelOf(label), AccessKind::requiresNew, 1},
                   {&label, AccessKind::modifies},
                   {&data::delT, AccessKind::requiresOld}};
  task.body = [components = label.components](const TaskContext& context) { reflux(context, components); };
  return task;
}

}  // namespace

TaskList withRefluxing(const TaskList& list) {
  std::map<std::string_view, int> last;  // task that keeps the fluxes, by the name of the rim's label
  for (std::size_t t = 0; t < list.tasks().size(); ++t)
    for (const Access& access : list.tasks()[t].accesses)
      if (access.label->centring == data::Centring::rim) last[access.label->name] = static_cast<int>(t);
  TaskList with;
  std::set<std::string_view> begun;
  for (std::size_t t = 0; t < list.tasks().size(); ++t) {
    Task task = list.tasks()[t];
    for (Access& access : task.accesses)
      if (access.keeps && !begun.insert(access.label->name).second) access.kind = AccessKind::modifies;
    with.add(task);
    for (const Access& access : task.accesses)
      if (access.keeps && last[access.label->name] == static_cast<int>(t))
        with.add(refluxTask(*access.keeps, task.perMaterial(access) ? task.materials : std::vector<std::string>()));
  }
  return with;
}

}  // namespace tushar::tasks
