#pragma once

#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/explicit/tasks/exchange_momentum.hpp"
#include "components/mpm/solid/explicit/tasks/transmit_force.hpp"

// What contact at the end of a step, and materials that transmit its forces, add to the schedule of SolidMpm.

namespace tushar::mpm::solid {

template <class Shape>
void SolidMpm<Shape>::scheduleContactAtEnd(TaskList& tasks) const {
  const Acceleration acceleration{problem_.method.gravity, problem_.method.damping};
  if (problem_.contacts.empty() && !transmitsForce()) return;
  tasks.acrossMaterials("mpm::exMomIntegrated", exchangeMomentumAtEnd<D>, problem_.materials, with(problem_.contacts),
                        with(acceleration), startTime(), requiresOld(delT), modifies(g::record),
                        computes(total::rigidReactionForce), when(transmitsForce(), computes(g::transmittedForce<D>)));
}

template <class Shape>
void SolidMpm<Shape>::scheduleTransmittedForce(TaskList& tasks) const {
  tasks.perRankAcrossMaterials("mpm::computeGridVelocityForFTM", computeGridVelocityForFTM<Shape>, problem_.materials,
                               togetherOnRanks(), requiresOld(delT), all<RigidMotion<Shape>>());
}

}  // namespace tushar::mpm::solid
