#include "core/tasks/task_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ostream>

#include "core/base/error.hpp"
#include "core/tasks/lifetimes.hpp"

namespace tushar::tasks {

using data::Centring;
using data::Generation;

namespace {

/// All labels that are used by the tasks.
std::map<std::string, const data::Label*, std::less<>> labelsOf(const std::vector<Task>& tasks) {
  std::map<std::string, const data::Label*, std::less<>> labels;
  for (const Task& task : tasks) {
    for (const Access& access : task.accesses) labels.try_emplace(std::string(access.label->name), access.label);
    if (task.kind != TaskKind::work) labels.try_emplace(std::string(data::particleId.name), &data::particleId);
  }
  return labels;
}

/// Whether a patch may run before the ghosts of other patches are filled: only if the task does not change the values
/// from which these ghosts are filled.
bool mayStartEarly(const CompiledTask& task, const data::VariableTable& table) {
  const auto isFilled = [&](const Access& access) {
    return std::any_of(task.fills.begin(), task.fills.end(), [&](const BoundGhostFill& fill) {
      return table[fill.variable].label->name == access.label->name;
    });
  };
  const std::vector<Access>& accesses = task.task.accesses;
  return task.task.kind == TaskKind::work && !task.task.acrossMaterials && !task.task.perRank &&
         std::none_of(accesses.begin(), accesses.end(),
                      [&](const Access& one) { return one.writes() && isFilled(one); });
}

bool outlivesStep(const data::Label& label) {
  return label.centring != Centring::reduction && label.centring != Centring::rim;
}

int materialOf(const Access& access, int material) {
  if (access.ofMaterial >= 0) return access.ofMaterial;
  return access.label->centring == Centring::reduction || access.ofNone ? -1 : material;
}

/// Whether any of the tasks uses a variable of a material.
bool isOf(const std::vector<Task>& tasks, std::string_view name, int material) {
  return std::any_of(tasks.begin(), tasks.end(), [&](const Task& task) {
    return std::any_of(task.accesses.begin(), task.accesses.end(), [&](const Access& access) {
      return access.label->name == name && task.rangeOf(access).contains(material);
    });
  });
}

/// Whether a variable belongs only to other materials than those of `made`, whose particles a task makes.
bool isOfOthers(const std::vector<Task>& tasks, const std::string& name, const MaterialRange& made,
                const data::VariableTable& table, int materials) {
  bool hasOther = false;
  for (int material = 0; material < materials; ++material) {
    const bool has = isOf(tasks, name, material) || table.find(name, material) >= 0;
    if (has && made.contains(material)) return false;
    hasOther = hasOther || has;
  }
  return hasOther;
}

}  // namespace

TaskGraph::TaskGraph(std::string name, Pruned pruned, const grid::Grid& grid, data::VariableTable& table)
    : name_(std::move(name)),
      pruned_(std::move(pruned)),
      dependencies_(connect(pruned_.kept)),
      placements_(place(pruned_.kept, grid)),
      sets_(particleSetsBefore(pruned_.kept)),
      lifetimes_(lifetimes(pruned_)) {
  for (std::size_t t = 0; t < pruned_.kept.size(); ++t) bind(t, table);
  const std::vector<Stage> stages = plan(pruned_.kept);
  for (std::size_t t = 0; t < stages.size(); ++t) {
    if (!stages[t].fills.empty()) tasks_[stages[t].ready + 1].sends = static_cast<int>(t);
    for (const GhostFill& fill : stages[t].fills)
      for (int m = fill.materials.first; m < fill.materials.end; ++m)
        tasks_[t].fills.push_back(
            {table.number(*fill.label, m), fill.generation, fill.set, fill.label->centring == Centring::particle});
  }
  for (const CompiledTask& task : tasks_)
    reductions_.insert(reductions_.end(), task.reductions.begin(), task.reductions.end());
  std::sort(reductions_.begin(), reductions_.end());
  reductions_.erase(std::unique(reductions_.begin(), reductions_.end()), reductions_.end());
  for (CompiledTask& task : tasks_) task.mayStartEarly = mayStartEarly(task, table);
  if (!tasks_.empty()) tasks_.back().isLast = true;
  noteResults(table);
}

void TaskGraph::bind(std::size_t t, data::VariableTable& table) {
  const Task& task = pruned_.kept[t];
  CompiledTask compiled;
  compiled.task = task;
  const int count = static_cast<int>(task.materials.size());
  materials_ = std::max(materials_, count);
  if (task.kind == TaskKind::newParticles) checkCreated(t, table);
  compiled.materials.resize(task.firstMaterial);  // those that it skips
  for (int m = task.range().first; m < task.range().end; ++m) compiled.materials.push_back(bindMaterial(t, m, table));
  for (const Access& access : task.accesses)
    if (access.label->centring == Centring::reduction)
      (access.writes() ? compiled.reductions : compiled.readReductions).push_back(table.number(*access.label, -1));
  for (const Access& access : task.accesses)
    if (access.writes() && access.label->name == data::recomputeTimeStep.name)
      compiled.recomputeTimeStep = table.number(*access.label, -1);
  tasks_.push_back(std::move(compiled));
}

/// Whether values outlive the step that no task writes.
bool TaskGraph::isCleared(const data::Label& label) const {
  return label.counts == data::Counts::nearParticles && pruned_.needed.contains(std::string(label.name));
}

MaterialBinding TaskGraph::bindMaterial(std::size_t t, int material, data::VariableTable& table) {
  const Task& task = pruned_.kept[t];
  MaterialBinding binding;
  for (const Access& access : task.accesses) {
    if (access.kind == AccessKind::leftOut) {
      binding.accesses.emplace_back();
      continue;
    }
    const int number = table.number(*access.label, materialOf(access, material));
    const Generation generation = access.isNew() ? Generation::fresh : Generation::old;
    const Generation set = access.isNew() ? sets_[t] : Generation::old;
    binding.accesses.push_back({number, generation, set, access.ghost, access.own});
    table.widen(number, access.ghost);
    const bool isOfAll = access.ofNone || access.ofMaterial >= 0;
    if (isOfAll && material > task.firstMaterial) continue;  // once for all materials
    if (access.own) binding.shared.push_back({number, set});
    if (access.kind == AccessKind::computes && access.label->centring != Centring::reduction)
      binding.outputs.push_back({number, set, isCleared(*access.label)});
    if (access.writes() && access.label->bound != data::Bound::none)
      binding.bounded.push_back({number, task.kind == TaskKind::newParticles ? Generation::fresh : set});
  }
  if (task.kind != TaskKind::work) table.number(data::particleId, material);
  if (task.kind == TaskKind::relocate) binding.carried = carriedBy(t, material, table);
  for (const std::string& label : lifetimes_[t]) {
    binding.freed.push_back(table.find(label, material));
    if (material < 0 || material > task.firstMaterial) continue;
    binding.freed.push_back(table.find(label, -1));
    for (const Access& access : task.accesses)
      if (access.ofMaterial >= 0 && access.label->name == label)
        binding.freed.push_back(table.find(label, access.ofMaterial));
  }
  std::erase(binding.freed, -1);
  return binding;
}

std::vector<Carried> TaskGraph::carriedBy(std::size_t t, int material, data::VariableTable& table) const {
  if (sets_[t] == Generation::fresh)
    throw TaskError("task relocate: a list may relocate particles only once, and only before it makes new ones");
  const std::vector<Task> before(pruned_.kept.begin(), pruned_.kept.begin() + static_cast<std::ptrdiff_t>(t));
  const Names produced = producedBy(before);
  const auto labels = labelsOf(pruned_.kept);
  Names live = pruned_.liveAfter[t];
  live.emplace(data::particleId.name);
  std::vector<Carried> carried;
  for (const std::string& name : live) {
    // Variables that no task of this list names were made by an earlier list; this list only carries them along.
    const auto known = labels.find(name);
    if (known != labels.end() && known->second->centring != Centring::particle) continue;
    const bool isNamed = known != labels.end() && isOf(pruned_.kept, name, material);
    const int number = isNamed ? table.number(*known->second, material) : table.find(name, material);
    if (number < 0 || table[number].label->centring != Centring::particle) continue;
    const bool isNew =
        produced.contains(name) && t + 1 < pruned_.kept.size();  // at the end of a list, values are old by then
    carried.push_back({number, isNew ? Generation::fresh : Generation::old});
  }
  return carried;
}

void TaskGraph::checkCreated(std::size_t t, const data::VariableTable& table) const {
  const Task& task = pruned_.kept[t];
  int materials = 0;
  for (const Task& other : pruned_.kept) materials = std::max(materials, static_cast<int>(other.materials.size()));
  std::string missing;
  for (const std::string& name : pruned_.liveAfter[t]) {
    if (!name.starts_with("p.") || name == data::particleId.name) continue;
    const bool created = std::any_of(task.accesses.begin(), task.accesses.end(), [&](const Access& access) {
      return access.kind == AccessKind::creates && access.label->name == name;
    });
    if (!created && !isOfOthers(pruned_.kept, name, task.range(), table, materials))
      missing += (missing.empty() ? "" : ", ") + name;
  }
  if (!missing.empty())
    throw TaskError(
        fmt::format("task {} makes new particles, but does not create {}, which is needed later", task.name, missing));
}

void TaskGraph::noteResults(data::VariableTable& table) {
  Names written = producedBy(pruned_.kept);
  bool changes = false;
  for (const CompiledTask& compiled : tasks_) {
    changes = changes || compiled.task.kind != TaskKind::work;
    for (const MaterialBinding& binding : compiled.materials)
      for (const Carried& carried : binding.carried)
        if (!compiled.isLast) written.emplace(table[carried.variable].label->name);
  }
  Names needed = pruned_.needed;
  if (changes) needed.emplace(data::particleId.name);
  for (const std::string& name : needed)
    if (written.contains(name))
      for (int m = -1; m < materials_; ++m)
        if (const int number = table.find(name, m); number >= 0 && outlivesStep(*table[number].label))
          results_.push_back(number);
  if (changes)
    for (int m = 0; m < materials_; ++m) changed_sets_.push_back(m);
}

}  // namespace tushar::tasks
