#pragma once

#include "core/data/reduction.hpp"
#include "core/tasks/task_list.hpp"
#include "core/tasks/validate.hpp"

namespace tushar::tasks {

/// Returns the list with an additional task for each variable whose fluxes are kept, placed after the last task that
/// stores its fluxes. In a coarse cell next to finer ones, this task replaces the flux through the face between them by
/// the mean of the finer fluxes,
///
///     U += ± dt / h (F - mean of the finer F),  + at upper faces,
///
/// axis by axis, the lower face first. So the amount that leaves one level enters the other, and totals are conserved
/// to round-off. Source: M. J. Berger and P. Colella, J. Comput. Phys. 82 (1989) 64.
///
/// Each of the tasks `after` is placed behind the last of these tasks whose variable it accesses; those that access
/// none are left out.
TaskList withRefluxing(const TaskList& list, const TaskList& after = {});

/// The fraction of the next coarser level's step that has elapsed when a level's step begins.
inline constexpr data::ReductionLabel<data::Minimum> partOfStep{
    "partOfStep", "1", "fraction of the next coarser level's step that has elapsed"};

/// The task lists of a step in which finer levels take several smaller steps.
struct SteppedByLevel {
  /// The step of one level: after the last task that keeps the fluxes of a variable, a task adds the fluxes times the
  /// step to a register, which sums over all steps within one step of the next coarser level.
  TaskList advance;
  /// Runs on the coarser level after the finer steps: U += ± 1 / h (dt F - mean of the finer level's sums of dt F), and
  /// then the tasks `after`.
  TaskList reflux;
};
SteppedByLevel withRegisters(const TaskList& list, const TaskList& after = {});

/// The names of the registers used in a list.
Names registersOf(const TaskList& list);

}  // namespace tushar::tasks
