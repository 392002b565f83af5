#pragma once

#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/explicit/tasks/exchange_momentum.hpp"
#include "components/mpm/solid/explicit/tasks/transmit_force.hpp"

// What contact at the end of a step, and materials that transmit its forces, add to the schedule of SolidMpm.

namespace tushar::mpm::solid {

template <class Shape>
void SolidMpm<Shape>::scheduleContactAtEnd(TaskList& tasks) const {
  const Acceleration acceleration{problem_.method.gravity, problem_.method.damping};
  if (transmitsForce())
    tasks.acrossMaterials("mpm::exMomIntegrated", exMomIntegratedTransmitting<D>, problem_.materials,
                          with(problem_.contacts), with(acceleration), startTime(), requiresOld(delT),
                          modifies(g::record), computes(total::rigidReactionForce), computes(g::transmittedForce<D>));
  else if (!problem_.contacts.empty())
    tasks.acrossMaterials("mpm::exMomIntegrated", exMomIntegrated<D>, problem_.materials, with(problem_.contacts),
                          with(acceleration), startTime(), requiresOld(delT), modifies(g::record),
                          computes(total::rigidReactionForce));
}

template <class Shape>
void SolidMpm<Shape>::scheduleTransmittedForce(TaskList& tasks) const {
  tasks.perRankAcrossMaterials("mpm::computeGridVelocityForFTM", computeGridVelocityForFTM<Shape>, problem_.materials,
                               togetherOnRanks(), requiresOld(delT), requiresOld(p::x<D>, Shape::reach),
                               requiresOld(p::mass), requiresNew(p::externalForce<D>),
                               requiresNew(g::transmittedForce<D>), modifies(g::record));
}

}  // namespace tushar::mpm::solid
