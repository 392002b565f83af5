#pragma once

#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/explicit/tasks/separate_bodies.hpp"
#include "components/mpm/solid/explicit/tasks/transmit_force.hpp"

// The part of the schedule of SolidMpm for contact and for materials that transmit its forces.

namespace tushar::mpm::solid {

/// The planes along which bodies slide.
template <class Shape>
void SolidMpm<Shape>::scheduleSeparateBodies(TaskList& tasks) const {
  const auto& [materials, commonSize] = std::tie(problem_.materials, problem_.method.commonSize);
  tasks.acrossMaterials("mpm::separateBodies", separateBodies<Shape>, materials, with(problem_.contacts),
                        with(commonSize), requiresNew(g::record),
                        all<PlaneSources<Shape>>(keepsSizes(), problem_.method.keepsSizes));
  if (frictionHasColor())
    tasks.perMaterial("mpm::interpolateColor", interpolateColor<Shape>, materials, with(commonSize),
                      all<Placed<Shape>>(keepsSizes(), static_cast<int>(Shape::reach)),
                      requiresOld(p::mass, Shape::reach), requiresOld(p::color, Shape::reach), requiresNew(g::record),
                      computes(g::color));
}

template <class Shape>
void SolidMpm<Shape>::scheduleTransmittedForce(TaskList& tasks) const {
  tasks.perRankAcrossMaterials("mpm::computeGridVelocityForFTM", computeGridVelocityForFTM<Shape>, problem_.materials,
                               togetherOnRanks(), requiresOld(delT),
                               all<RigidMotion<Shape>>(problem_.surroundings != nullptr));
}

}  // namespace tushar::mpm::solid
