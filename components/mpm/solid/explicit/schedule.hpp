#pragma once

#include "components/mpm/solid/explicit/schedule_contact.hpp"
#include "components/mpm/solid/explicit/schedule_heat.hpp"
#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/explicit/tasks/affine.hpp"
#include "components/mpm/solid/explicit/tasks/friction.hpp"
#include "components/mpm/solid/explicit/tasks/gradient_enhanced.hpp"
#include "components/mpm/solid/explicit/tasks/integrate_acceleration.hpp"
#include "components/mpm/solid/explicit/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/explicit/tasks/interpolate_to_particles_and_update.hpp"
#include "components/mpm/solid/explicit/tasks/measure_work.hpp"
#include "components/mpm/solid/explicit/tasks/prescribe_motion.hpp"
#include "components/mpm/solid/explicit/tasks/update_in_parts.hpp"
#include "components/mpm/solid/explicit/tasks/velocity_updates.hpp"
#include "components/mpm/solid/tasks/show_grid.hpp"

// The schedule of SolidMpm: included by the files that instantiate it, one for each kind of shape function.

namespace tushar::mpm::solid {

template <class Shape>
void SolidMpm<Shape>::scheduleTimeAdvance(TaskList& tasks) const {
  if (isLoaded()) scheduleApplyExternalLoads(tasks);
  if (hasFriction()) scheduleComputeSurface(tasks);
  switch (problem_.method.stressUpdate) {
    case StressUpdate::last:
      scheduleMomentum(tasks, readsOld);
      problem_.method.sharesVolume ? scheduleUpdateInCells(tasks) : scheduleUpdateParticles(tasks);
      scheduleVelocityUpdate(tasks, readsOld);
      break;
    case StressUpdate::modifiedLast:
      scheduleMomentum(tasks, readsOld);
      scheduleMoveParticles(tasks, readsOld);
      scheduleVelocityUpdate(tasks, readsOld);
      scheduleInterpolateMomentum(tasks, readsNew);
      scheduleComputeStressTensor(tasks, g::stressRecord);
      break;
    case StressUpdate::first:
      scheduleInterpolateMomentum(tasks, readsOld);
      scheduleComputeStressTensor(tasks, g::stressRecord);
      scheduleMomentum(tasks, readsNew);
      scheduleMoveParticles(tasks, readsNew);
      scheduleVelocityUpdate(tasks, readsNew);
      break;
  }
  scheduleEndOfStep(tasks);
}

template <class Shape>
void SolidMpm<Shape>::scheduleMomentum(TaskList& tasks, Reads stressed) const {
  scheduleInterpolateParticlesToGrid(tasks, stressed);
  scheduleIntegrateAcceleration(tasks);
  scheduleMeasureWork(tasks, stressed);
  scheduleHeat(tasks);
}

/// With the forces of the stresses: Uintah's computeInternalForce. `stressed` reads F and the stress.
template <class Shape>
void SolidMpm<Shape>::scheduleInterpolateParticlesToGrid(TaskList& tasks, Reads stressed) const {
  const int reach = Shape::reach;
  Keeps scattered = keeps();
  scattered.externalForce = isLoaded() && !problem_.method.loadsAtCorners;
  tasks.perMaterial(
      "mpm::interpolateParticlesToGrid", interpolateParticlesToGrid<Shape>, problem_.materials,
      with(problem_.method.commonSize), with(clearsAllNodes()),
      all<MomentumSources<Shape>>(keepsSizes(), requiresOld(p::velocity<D>, reach),
                                  when(!keeps_stress_ || Shape::deforms, stressed(p::deformationMeasure, reach))),
      all<ForceSources<Shape>>(scattered, stressed), computesOwn(g::record));
  scheduleCornerLoads(tasks);
  if constexpr (!Shape::deforms && !Shape::axisymmetric)
    if (problem_.method.affine)
      tasks.perMaterial("mpm::addAffineVelocity", addAffineVelocity<Shape>, problem_.materials,
                        with(problem_.method.commonSize), all<Placed<Shape>>(keepsSizes(), reach),
                        requiresOld(p::mass, reach), requiresOld(p::affineMoment, reach), modifies(g::record));
  if (problem_.method.projectsGradient)
    tasks.perMaterial("mpm::addVelocityGradient", addVelocityGradient<Shape>, problem_.materials,
                      with(problem_.method.commonSize), all<Placed<Shape>>(keepsSizes(), reach),
                      requiresOld(p::mass, reach), requiresOld(p::velocityGradient, reach), modifies(g::record));
  if (hasPlanes()) scheduleSeparateBodies(tasks);
  if (!problem_.contacts.empty()) scheduleContact(tasks, "mpm::exMomInterpolated", Moment::start, g::record);
  if (hasFriction()) scheduleFriction(tasks, "mpm::frictionInterpolated", Moment::start, g::record);
}

template <class Shape>
void SolidMpm<Shape>::scheduleComputeSurface(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeSurface", computeSurface<Shape>, problem_.materials, with(problem_.method.commonSize),
                    all<SurfaceSources<Shape>>(keeps()));
}

template <class Shape>
void SolidMpm<Shape>::scheduleIntegrateAcceleration(TaskList& tasks) const {
  scheduleSurroundingForce(tasks);
  tasks.perMaterial("mpm::computeAndIntegrateAcceleration", computeAndIntegrateAcceleration<Shape>, problem_.materials,
                    with(problem_.method), requiresOld(p::x<D>, Shape::reach), requiresOld(delT), modifies(g::record));
  scheduleKeepVelocity(tasks, g::velocityOfForces<D>);
  scheduleContactAtEnd(tasks);
  if (hasFriction()) scheduleFriction(tasks, "mpm::frictionIntegrated", Moment::end, g::record, rubbingHeats());
  scheduleKeepVelocity(tasks, g::velocityOfContact<D>);
  tasks.perMaterial("mpm::setGridBoundaryConditions", setGridBoundaryConditions<Shape>, problem_.materials,
                    requiresOld(p::x<D>, Shape::reach), modifies(g::record));
  schedulePrescribedMotion(tasks, g::record);
  if (transmitsForce()) scheduleTransmittedForce(tasks);
}

template <class Shape>
void SolidMpm<Shape>::schedulePrescribedMotion(TaskList& tasks, const NodeLabel<NodeRecord>& record) const {
  if (problem_.motion)
    tasks.perMaterial("mpm::prescribeMotion", prescribeMotion<Shape>, problem_.materials, with(problem_.motion.get()),
                      startTime(), requiresOld(p::x<D>, Shape::reach), modifies(record));
}

/// Runs only if work is saved or reported, as scheduleStrainWork; `shaped` reads the F that shape functions follow.
template <class Shape>
void SolidMpm<Shape>::scheduleMeasureWork(TaskList& tasks, Reads shaped) const {
  scheduleNodalWork(tasks);
  tasks.perMaterial("mpm::measureWork", measureWork<Shape>, problem_.materials, with(problem_.method.commonSize),
                    requiresOld(delT), all<ParticleWork<Shape>>(keeps(), shapedBy(shaped)));
}
/// With the gradients and the stresses: Uintah's computeParticleGradients and computeStressTensor.
template <class Shape>
void SolidMpm<Shape>::scheduleUpdateParticles(TaskList& tasks) const {
  tasks.perMaterial("mpm::interpolateToParticlesAndUpdate", interpolateToParticlesAndUpdate<Shape>, problem_.materials,
                    with(problem_.method), startTime(), requiresOld(delT), all<ParticleUpdate<Shape>>(keeps()));
  scheduleDamage(tasks);
}

/// The motion apart from the stress, in which the particles of a cell share their change of volume.
template <class Shape>
void SolidMpm<Shape>::scheduleUpdateInCells(TaskList& tasks) const {
  scheduleMoveParticles(tasks, readsOld);
  scheduleComputeStressTensor(tasks, g::record);
}

/// x and v alone; `shaped` reads the F that shape functions follow.
template <class Shape>
void SolidMpm<Shape>::scheduleMoveParticles(TaskList& tasks, Reads shaped) const {
  tasks.perMaterial("mpm::interpolateToParticlesAndUpdate", moveParticles<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(delT),
                    all<MotionUpdate<Shape>>(keepsSizes(), shapedBy(shaped)));
}

/// Schedules the update that replaces FLIP's velocity; `shaped` reads the F that shape functions follow.
template <class Shape>
void SolidMpm<Shape>::scheduleVelocityUpdate(TaskList& tasks, Reads shaped) const {
  const auto particles = all<Placed<Shape>>(keepsSizes(), 0, shapedBy(shaped));
  const auto record = requiresNew(g::record, Shape::ghostNodes);
  const auto& [materials, method] = std::tie(problem_.materials, problem_.method);
  if (method.picFraction > 0)
    tasks.perMaterial("mpm::blendVelocity", blendVelocity<Shape>, materials, with(method), record, particles,
                      modifies(p::velocity<D>));
  if (method.xpic) {
    const int reach = Shape::reach;
    tasks.perMaterial("mpm::computeSSPlusVp", computeSSPlusVp<Shape>, materials, with(method.commonSize), record,
                      particles, computes(p::smoothVelocity<D>));
    tasks.perMaterial(
        "mpm::computeSPlusSSPlusVp", interpolateMomentum<Shape>, materials, with(method.commonSize),
        all<MomentumSources<Shape>>(keepsSizes(), requiresNew(p::smoothVelocity<D>, reach), shapedBy(shaped, reach)),
        computesOwn(g::smoothRecord));
    tasks.perMaterial("mpm::applyXpic", applyXpic<Shape>, materials, with(method.commonSize), requiresOld(delT),
                      all<XpicUpdate<Shape>>(keepsSizes(), shapedBy(shaped)));
  }
  if constexpr (!Shape::deforms && !Shape::axisymmetric)
    if (method.affine)
      tasks.perMaterial("mpm::updateAffineMoment", updateAffineMoment<Shape>, materials, with(method.commonSize),
                        record, particles, computes(p::affineMoment));
}

/// The velocity that stresses follow, if it is not that of the motion; `moving` reads that of the particles.
template <class Shape>
void SolidMpm<Shape>::scheduleInterpolateMomentum(TaskList& tasks, Reads moving) const {
  const int reach = Shape::reach;
  tasks.perMaterial("mpm::interpolateMomentum", interpolateMomentum<Shape>, problem_.materials,
                    with(problem_.method.commonSize),
                    all<MomentumSources<Shape>>(keepsSizes(), moving(p::velocity<D>, reach), shapedBy(readsOld, reach)),
                    computesOwn(g::stressRecord));
  if (!problem_.contacts.empty()) scheduleContact(tasks, "mpm::exMomOfStresses", Moment::end, g::stressRecord);
  if (hasFriction()) scheduleFriction(tasks, "mpm::frictionOfStresses", Moment::end, g::stressRecord);
  tasks.perMaterial("mpm::setGridBoundaryConditionsOfStresses", setGridBoundaryConditions<Shape>, problem_.materials,
                    requiresOld(p::x<D>, reach), modifies(g::stressRecord));
  schedulePrescribedMotion(tasks, g::stressRecord);
}

/// F and the stress, apart from the motion, with the velocity of `record`.
template <class Shape>
void SolidMpm<Shape>::scheduleComputeStressTensor(TaskList& tasks, const NodeLabel<NodeRecord>& record) const {
  const auto body = problem_.method.sharesVolume ? computeStressTensor<Shape, Volumes::shared>
                                                 : computeStressTensor<Shape, Volumes::own>;
  tasks.perMaterial("mpm::computeStressTensor", body, problem_.materials, with(problem_.method), startTime(),
                    requiresOld(delT), all<StateUpdate<Shape>>(keeps(), &record));
  scheduleDamage(tasks);
}

template <class Shape>
void SolidMpm<Shape>::scheduleShowOnGrid(TaskList& tasks, Reads stressed) const {
  solid::scheduleShowOnGrid<Shape>(tasks, problem_.materials, problem_.method.commonSize, keepsSizes(),
                                   stressed(p::volume, Shape::reach), stressed(p::stress, Shape::reach));
}

}  // namespace tushar::mpm::solid
