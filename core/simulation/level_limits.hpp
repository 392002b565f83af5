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
/// - tasks that see all patches of a rank and all materials at once, whose bodies are written for one level;
/// - fluxes of materials, because refluxing supports only variables without material. `where` is the tag that makes the
/// levels.
std::vector<InputProblem> problemsOnLevels(const std::vector<tasks::Task>& tasks, const grid::Grid& grid,
                                           const Location& where);

/// The first task of a step that prevents smaller steps on finer levels, with its label, and the number of further such
/// tasks. Tasks that allow it compute cells, from the old state and, in the same cell, from what earlier tasks
/// computed. Others see new values that another level does not have yet, or add up over the grid what is there at
/// different times. `where` is the tag that has levels take smaller steps.
std::optional<InputProblem> problemOfSmallerSteps(const std::vector<tasks::Task>& tasks, const Location& where);

}  // namespace tushar::simulation
