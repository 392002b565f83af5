#pragma once

#include "core/grid/level.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::tasks {

/// The list with a task behind the last one that keeps the fluxes of a variable, for each such variable: in a coarse
/// cell beside finer ones, the flux through the face between them becomes the mean of the finer ones,
///
///     U += ± dt / h (F - mean of the finer F),  + at upper faces,
///
/// axis by axis, the lower face first. So what leaves one level arrives in the other, and totals are kept to round-off.
/// Source: M. J. Berger and P. Colella, J. Comput. Phys. 82 (1989) 64.
TaskList withRefluxing(const TaskList& list);

}  // namespace tushar::tasks
