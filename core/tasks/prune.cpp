#include "core/tasks/prune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tushar::tasks {

namespace {

bool particlesAmong(const Names& names) {
  return std::any_of(names.begin(), names.end(), [](const std::string& name) { return name.starts_with("p."); });
}

bool isNeeded(const Task& task, const Names& live) {
  if (task.kind != TaskKind::work && particlesAmong(live)) return true;
  return std::any_of(task.accesses.begin(), task.accesses.end(),
                     [&](const Access& access) { return access.writes() && live.contains(access.label->name); });
}

bool makes(const Access& access) {
  return (access.kind == AccessKind::computes || access.kind == AccessKind::creates) &&
         access.label->centring != data::Centring::reduction;
}

/// Names of variables that several tasks compute, each for other materials.
Names madeInParts(const std::vector<Task>& tasks) {
  Names names;
  std::map<std::string_view, MaterialRange> made;
  for (const Task& task : tasks)
    for (const Access& access : task.accesses) {
      if (!makes(access)) continue;
      const MaterialRange range = task.rangeOf(access);
      const auto [first, isFirst] = made.emplace(access.label->name, range);
      if (!isFirst && !first->second.overlaps(range)) names.emplace(access.label->name);
    }
  return names;
}

/// Turns the variables that are live after a kept task into those that are live before it. Every task adds its part to
/// a reduction, and to a variable made in parts.
void stepBack(const Task& task, const Names& inParts, Names& live) {
  for (const Access& access : task.accesses)
    if (makes(access) && !inParts.contains(access.label->name)) live.erase(std::string(access.label->name));
  for (const Access& access : task.accesses)
    if (access.kind == AccessKind::requiresNew || access.kind == AccessKind::modifies) live.emplace(access.label->name);
}

struct Sweep {
  std::vector<bool> kept;
  std::vector<Names> liveAfter;  ///< live variables after each task
};

Sweep sweep(const std::vector<Task>& tasks, Names live) {
  Sweep result{std::vector<bool>(tasks.size()), std::vector<Names>(tasks.size())};
  const Names inParts = madeInParts(tasks);
  for (std::size_t t = tasks.size(); t-- > 0;) {
    result.liveAfter[t] = live;
    result.kept[t] = isNeeded(tasks[t], live);
    if (result.kept[t]) stepBack(tasks[t], inParts, live);
  }
  return result;
}

std::string whyNot(const Task& task) {
  std::string results;
  for (const Access& access : task.accesses)
    if (access.writes()) results += fmt::format("{}{}", results.empty() ? "" : ", ", access.label->name);
  return fmt::format("nothing reads or saves {}", results.empty() ? "its results" : results);
}

std::vector<Task> select(const std::vector<Task>& tasks, const std::vector<bool>& kept) {
  std::vector<Task> selected;
  for (std::size_t t = 0; t < tasks.size(); ++t)
    if (kept[t]) selected.push_back(tasks[t]);
  return selected;
}

/// Omits the offered outputs of a task that nothing reads after it.
void leaveOutOffers(Task& task, const Names& liveAfter) {
  for (Access& access : task.accesses)
    if (access.offered && !liveAfter.contains(access.label->name)) access.kind = AccessKind::leftOut;
}

/// Particle variables that the list does not compute before a relocation but needs after it.
Names carriedFromState(const std::vector<Task>& tasks, const Sweep& swept) {
  Names carried, produced;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    if (!swept.kept[t]) continue;
    if (tasks[t].kind == TaskKind::relocate)
      for (const std::string& name : swept.liveAfter[t])
        if (name.starts_with("p.") && !produced.contains(name)) carried.insert(name);
    produced.merge(producedBy({tasks[t]}));
  }
  return carried;
}

}  // namespace

Names requiredOfState(const std::vector<Task>& tasks) {
  Names names;
  for (const Task& task : tasks)
    for (const Access& access : task.accesses)
      if (access.kind == AccessKind::requiresOld) names.emplace(access.label->name);
  return names;
}

Pruned prune(const std::vector<Task>& tasks, const Names& wanted, bool repeated) {
  Pruned result;
  result.needed = wanted;
  Sweep swept = sweep(tasks, wanted);
  for (bool grew = repeated; grew;) {
    const std::size_t before = result.needed.size();
    result.needed.merge(requiredOfState(select(tasks, swept.kept)));
    result.needed.merge(carriedFromState(tasks, swept));
    grew = result.needed.size() > before;
    swept = sweep(tasks, result.needed);
  }
  result.kept = select(tasks, swept.kept);
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    if (swept.kept[t]) {
      leaveOutOffers(result.kept[result.liveAfter.size()], swept.liveAfter[t]);
      result.liveAfter.push_back(swept.liveAfter[t]);
    } else {
      result.leftOut.push_back({tasks[t].name, whyNot(tasks[t])});
    }
  }
  return result;
}

}  // namespace tushar::tasks
