#include "core/tasks/reflux.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/data/rim_flux.hpp"

namespace tushar::tasks {

namespace {

/// Indices of the accesses of the task that corrects a variable: the fluxes or their register, the variable, the time
/// step.
enum { fluxes, variable, timeStep };

/// Corrects U += ± dt (F - mean of the finer F) / h; `dt` is 1 if the register contains dt F.
void reflux(const TaskContext& context, int components, double dt) {
  const grid::Patch& patch = context.patch();
  const data::Variable rim = context.variable(fluxes), cells = context.variable(variable);
  for (const grid::RimPiece& piece : context.rims()) {
    if (!piece.isFiner) continue;
    const double ratio = (piece.side == 0 ? -dt : dt) / patch.level().spacing(piece.axis);
    const auto* own = reinterpret_cast<const double*>(rim.values) + piece.first * static_cast<std::size_t>(components);
    const double* finer = own + piece.cells.size() * static_cast<std::size_t>(components);
    auto* values = reinterpret_cast<double*>(cells.values);
    grid::forEachRow<3>(piece.cells, [&](const Index3& first, int count) {
      double* value = values + cells.stored.offset(first) * static_cast<std::size_t>(components);
      for (int left = count * components; left > 0; --left) *value++ += ratio * (*own++ - *finer++);
    });
  }
}

/// A variable with stored fluxes, and its materials, which are empty if it does not belong to materials.
struct Flowing {
  const data::Label* label;
  std::vector<std::string> materials;

  std::string named(const char* verb) const { return fmt::format("{} {}", verb, label->name); }
};

Task refluxTask(const Flowing& flowing) {
  Task task;
  task.name = flowing.named("reflux");
  task.materials = flowing.materials;
  task.accesses = {{&data::rimLabelOf(*flowing.label), AccessKind::requiresNew, 1},
                   {flowing.label, AccessKind::modifies},
                   {&data::delT, AccessKind::requiresOld}};
  task.body = [components = flowing.label->components](const TaskContext& context) {
    reflux(context, components, context.reduction<data::Minimum>(timeStep).value);
  };
  return task;
}

/// The label of the register of a variable: the sums of dt F through the rims of patches, named `rim.sum.` and the name
/// of the variable.
const data::Label& registerOf(const data::Label& label) { return data::rimLabelOf(data::rimLabelOf(label)); }

/// Indices of the accesses of the task that adds to a register.
enum { rim, sums, step, part };

/// Adds the fluxes of a step to the register. A level resets the sums for its faces to finer cells at each of its
/// steps; those for faces to coarser cells accumulate over all steps within a coarser step.
void addToRegister(const TaskContext& context, int components) {
  const double dt = context.reduction<data::Minimum>(step).value;
  const bool isFirst = context.reduction<data::Minimum>(part).value == 0;
  const auto* through = reinterpret_cast<const double*>(context.variable(rim).values);
  auto* sum = reinterpret_cast<double*>(context.variable(sums).values);
  for (const grid::RimPiece& piece : context.rims()) {
    const std::size_t first = piece.first * static_cast<std::size_t>(components);
    const std::size_t end = first + piece.cells.size() * static_cast<std::size_t>(components);
    for (std::size_t k = first; k < end; ++k)
      sum[k] = isFirst || piece.isFiner ? dt * through[k] : sum[k] + dt * through[k];
  }
}

Task registerTask(const Flowing& flowing) {
  Task task;
  task.name = flowing.named("register fluxes of");
  task.materials = flowing.materials;
  task.accesses = {{&data::rimLabelOf(*flowing.label), AccessKind::requiresNew},
                   {&registerOf(*flowing.label), AccessKind::computes},
                   {&data::delT, AccessKind::requiresOld},
                   {&partOfStep, AccessKind::requiresOld}};
  task.body = [components = flowing.label->components](const TaskContext& context) {
    addToRegister(context, components);
  };
  return task;
}

Task refluxTaskOfSteps(const Flowing& flowing) {
  Task task;
  task.name = flowing.named("reflux");
  task.materials = flowing.materials;
  task.accesses = {{&registerOf(*flowing.label), AccessKind::requiresNew, 1}, {flowing.label, AccessKind::modifies}};
  task.body = [components = flowing.label->components](const TaskContext& context) { reflux(context, components, 1); };
  return task;
}

/// Returns the list in which the first task that stores the fluxes of a variable sets them, and later tasks add to
/// them. After the last of these tasks, calls `behind(list, flowing)`, which may add tasks.
template <class Behind>
TaskList withTasksBehindFluxes(const TaskList& list, const Behind& behind) {
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
        behind(with, Flowing{access.keeps, task.perMaterial(access) ? task.materials : std::vector<std::string>()});
  }
  return with;
}

/// Whether a task is that which corrects a variable that another task accesses.
bool corrects(const Task& task, const Task& other) {
  return std::any_of(other.accesses.begin(), other.accesses.end(), [&](const Access& access) {
    return task.name == Flowing{access.label, {}}.named("reflux");
  });
}

/// Returns the list with the tasks `after`, each behind the last task that corrects any of its variables.
TaskList withTasksAfter(const TaskList& list, const TaskList& after) {
  std::vector<std::vector<Task>> behind(list.tasks().size());
  for (const Task& task : after.tasks())
    for (std::size_t t = behind.size(); t-- > 0;)
      if (corrects(list.tasks()[t], task)) {
        behind[t].push_back(task);
        break;
      }
  TaskList with;
  for (std::size_t t = 0; t < behind.size(); ++t) {
    with.add(list.tasks()[t]);
    for (const Task& task : behind[t]) with.add(task);
  }
  return with;
}

}  // namespace

TaskList withRefluxing(const TaskList& list, const TaskList& after) {
  const auto add = [](TaskList& with, const Flowing& flowing) { with.add(refluxTask(flowing)); };
  return withTasksAfter(withTasksBehindFluxes(list, add), after);
}

SteppedByLevel withRegisters(const TaskList& list, const TaskList& after) {
  SteppedByLevel lists;
  lists.advance = withTasksBehindFluxes(list, [&](TaskList& with, const Flowing& flowing) {
    with.add(registerTask(flowing));
    lists.reflux.add(refluxTaskOfSteps(flowing));
  });
  lists.reflux = withTasksAfter(lists.reflux, after);
  return lists;
}

Names registersOf(const TaskList& list) {
  Names names;
  for (const Task& task : list.tasks())
    for (const Access& access : task.accesses)
      if (access.label->centring == data::Centring::rim && access.writes() && !access.keeps)
        names.emplace(access.label->name);
  return names;
}

}  // namespace tushar::tasks
