#include "core/simulation/level_limits.hpp"

#include <fmt/format.h>

#include "core/tasks/ghost_plan.hpp"
#include "core/tasks/reflux.hpp"

namespace tushar::simulation {

namespace {

using data::Centring;

/// The reason why blocks are too small for the ghosts of an access; empty if they are not.
std::string blockProblem(const tasks::Task& task, const tasks::Access& access, const grid::Grid& grid) {
  const int fewest = tasks::fewestCellsOfBlock(access.ghost);
  for (int d = 0; d < grid.dimension(); ++d)
    if (const int cells = grid.blockCells()[d]; cells < fewest)
      return fmt::format(
          "task {} reads {} up to {} outside a patch, so blocks need {} cells along each axis, but have {} along {}; "
          "give <min_patch_size> in <Regridder> of <AMR>",
          task.name, access.label->name, counted(access.ghost, "cell"), fewest, cells, "xyz"[grid.level().axis(d)]);
  return "";
}

std::string accessProblem(const tasks::Task& task, const tasks::Access& access, const grid::Grid& grid) {
  const Centring centring = access.label->centring;
  if (centring == Centring::cell && access.ghost > 0) return blockProblem(task, access, grid);
  if (centring == Centring::node && !access.isNew())
    return fmt::format("task {} reads {} of nodes from the previous step, which needs a grid of one level", task.name,
                       access.label->name);
  if (centring == Centring::node && access.ghost > 0 && !task.perMaterial())
    return fmt::format("task {} reads {} of nodes outside a patch, which needs a grid of one level", task.name,
                       access.label->name);
  return "";
}

/// The reason why an access does not allow smaller steps on finer levels; empty if it does.
std::string accessAgainstSmallerSteps(const tasks::Access& access) {
  const std::string_view name = access.label->name;
  switch (access.label->centring) {
    case Centring::particle:
      return fmt::format("uses particles ({})", name);
    case Centring::node:
      return fmt::format("uses nodes ({})", name);
    case Centring::reduction:
      if (name == data::delT.name || name == tasks::partOfStep.name) return "";
      if (access.writes()) return fmt::format("computes {} over the whole grid", name);
      return fmt::format("reads {}, which is computed over the whole grid", name);
    case Centring::cell:
      if (access.isNew() && access.reads() && access.ghost > 0)
        return fmt::format("reads the new {} outside a patch, where another level may not have computed it yet", name);
      return "";
    default:
      return "";
  }
}

std::string taskAgainstSmallerSteps(const tasks::Task& task) {
  if (task.kind != tasks::TaskKind::work) return "moves particles";
  if (task.perRank) return "needs all patches at once";
  for (const tasks::Access& access : task.accesses)
    if (std::string problem = accessAgainstSmallerSteps(access); !problem.empty()) return problem;
  return "";
}

}  // namespace

std::optional<InputProblem> problemOfSmallerSteps(const std::vector<tasks::Task>& tasks, const Location& where) {
  std::string first;
  int others = 0;
  for (const tasks::Task& task : tasks) {
    const std::string problem = taskAgainstSmallerSteps(task);
    if (problem.empty()) continue;
    if (first.empty())
      first = fmt::format("task {} {}", task.name, problem);
    else
      ++others;
  }
  if (first.empty()) return std::nullopt;
  if (others > 0)
    first += fmt::format(", and {} also {} out smaller steps", counted(others, "other task"),
                         others == 1 ? "rules" : "rule");
  return InputProblem{where, "AMR/useLockStep", first + ": all levels must take the same time step, as by default"};
}

std::vector<InputProblem> problemsOnLevels(const std::vector<tasks::Task>& tasks, const grid::Grid& grid,
                                           const Location& where) {
  std::vector<InputProblem> problems;
  if (grid.levels() == 1) return problems;
  for (const tasks::Task& task : tasks) {
    const bool seesTooMuch = task.perRank && task.perMaterial();
    if (seesTooMuch)
      problems.push_back(
          {where, "", fmt::format("task {} needs all patches at once, and hence a grid of one level", task.name)});
    for (const tasks::Access& access : task.accesses)
      if (std::string problem = seesTooMuch ? "" : accessProblem(task, access, grid); !problem.empty())
        problems.push_back({where, "", std::move(problem)});
  }
  return problems;
}

}  // namespace tushar::simulation
