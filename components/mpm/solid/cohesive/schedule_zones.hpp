#pragma once

#include "components/mpm/solid/problem.hpp"

// The tasks of cohesive zones, for scenes that have any.

namespace tushar::mpm::solid {

/// Adds the task that creates the zones.
template <int D>
void scheduleNewZones(TaskList& tasks, const Problem& problem);
/// Adds the tasks that add the forces of zones to the records of the nodes, before velocities are integrated.
template <int D>
void scheduleZoneForces(TaskList& tasks, const Problem& problem);
/// Adds the tasks that move zones with the velocities v* of the nodes.
template <int D>
void scheduleZoneMotion(TaskList& tasks, const Problem& problem);
/// Adds the sum of the energy that zones have taken.
template <int D>
void scheduleZoneTotals(TaskList& tasks, const Problem& problem);

}  // namespace tushar::mpm::solid
