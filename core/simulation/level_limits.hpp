#pragma once

#include <optional>
#include <vector>

#include "core/base/error.hpp"
#include "core/grid/grid.hpp"
#include "core/tasks/task.hpp"

namespace tushar::simulation {

/// Problems of tasks on a grid of several levels, each with the name of the task and its label; none on a single level:
/// - blocks that are too small for the ghosts that a task reads (see tasks::fewestCellsOfBlock);
/// - ghost nodes, which have no values between levels; tasks of materials may read them near their particles, which are
/// on the finest level and remain some cells away from coarser cells;
/// - node variables from the previous step, which regridding and checkpoints do not include;
/// - tasks that receive all patches of a rank and all materials together, because their bodies are written for one
/// level;
/// - fluxes of materials, because refluxing supports only variables without material. `where` is the tag that requests
/// the levels.
std::vector<InputProblem> problemsOnLevels(const std::vector<tasks::Task>& tasks, const grid::Grid& grid,
                                           const Location& where);

/// The first task of a step that rules out smaller steps on finer levels, with its label, and the number of further
/// such tasks. A task allows smaller steps if it computes cells from the old state and from results of earlier tasks in
/// the same cell. Other tasks would read new values that another level does not have yet, or add up values of different
/// times. `where` is the tag that requests smaller steps.
std::optional<InputProblem> problemOfSmallerSteps(const std::vector<tasks::Task>& tasks, const Location& where);

}  // namespace tushar::simulation
