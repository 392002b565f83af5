#pragma once

#include <vector>

#include "core/base/error.hpp"
#include "core/grid/grid.hpp"
#include "core/tasks/task.hpp"

namespace tushar::simulation {

/// The problems of tasks on a grid of several levels, each with the task and its label; none on a single level:
/// - blocks that are too small for the ghosts that a task reads (see tasks::fewestCellsOfBlock);
/// - ghosts of nodes, which patches of the same level alone could give. Tasks of materials may read them for their
///   particles, which are on the finest level and keep away from coarser cells;
/// - variables of nodes from the step before, which regridding and checkpoints leave out;
/// - tasks that see all patches of a rank and all materials at once, whose bodies know of one level;
/// - fluxes of materials: refluxing is for variables of none.
/// `where`: what makes the levels.
std::vector<InputProblem> problemsOnLevels(const std::vector<tasks::Task>& tasks, const grid::Grid& grid,
                                           const Location& where);

}  // namespace tushar::simulation
