#pragma once

#include "components/mpm/solid/explicit/schedule_contact.hpp"
#include "components/mpm/solid/explicit/schedule_heat.hpp"
#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/explicit/tasks/affine.hpp"
#include "components/mpm/solid/explicit/tasks/corner_loads.hpp"
#include "components/mpm/solid/explicit/tasks/exchange_momentum.hpp"
#include "components/mpm/solid/explicit/tasks/friction.hpp"
#include "components/mpm/solid/explicit/tasks/gradient_enhanced.hpp"
#include "components/mpm/solid/explicit/tasks/integrate_acceleration.hpp"
#include "components/mpm/solid/explicit/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/explicit/tasks/interpolate_to_particles_and_update.hpp"
#include "components/mpm/solid/explicit/tasks/measure_work.hpp"
#include "components/mpm/solid/explicit/tasks/prescribe_motion.hpp"
#include "components/mpm/solid/explicit/tasks/stable_time_step.hpp"
#include "components/mpm/solid/explicit/tasks/update_in_parts.hpp"
#include "components/mpm/solid/explicit/tasks/velocity_updates.hpp"
#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "components/mpm/solid/tasks/boundary_force.hpp"
#include "components/mpm/solid/tasks/damage.hpp"
#include "components/mpm/solid/tasks/diagnose.hpp"
#include "components/mpm/solid/tasks/displacement.hpp"
#include "components/mpm/solid/tasks/nonlocal.hpp"
#include "components/mpm/solid/tasks/show_grid.hpp"
#include "components/mpm/solid/tasks/surrounding_force.hpp"

// The schedule of SolidMpm: included by the files that instantiate it, one for each kind of shape function.

namespace tushar::mpm::solid {

/// Reads variables as they were at the start of the step, or as the step has them.
inline constexpr auto old = [](const auto& label, int ghost) { return requiresOld(label, ghost); };
inline constexpr auto fresh = [](const auto& label, int ghost) { return requiresNew(label, ghost); };

template <class Shape>
SolidMpm<Shape>::SolidMpm(Problem problem) : Solids(std::move(problem)) {
  const auto any = [&](auto&& holds) {
    return std::any_of(problem_.materials.begin(), problem_.materials.end(),
                       [&](const Material& m) { return holds(*m.model); });
  };
  is_damageable_ = std::any_of(problem_.materials.begin(), problem_.materials.end(),
                               [](const Material& material) { return material.isDamageable(); });
  keeps_stress_ = is_damageable_ || any([](const Model& model) { return !model.dependsOnDeformationOnly(); });
  is_thermal_ = any([](const Model& model) { return model.usesTemperature(); });
  heats_ = any([](const Model& model) { return model.changesTemperature(); });
}

template <class Shape>
void SolidMpm<Shape>::scheduleInitialize(TaskList& tasks) const {
  scheduleActuallyInitialize<D>(tasks, problem_.materials, problem_.start);
  tasks.perMaterial("mpm::computeInitialTimeStep", computeInitialTimeStep<D>, problem_.materials,
                    requiresNew(p::velocity<D>), requiresNew(p::temperature), requiresNew(p::deformationMeasure),
                    computes(c::stableTimeStep));
  if (keeps_stress_) scheduleInitialStress(tasks, problem_.materials, state_);
  if (hasPlanes())
    tasks.perMaterial("mpm::findSurface", findSurface<D>, problem_.materials, requiresNew(p::x<D>),
                      computes(p::surface));
  if (problem_.method.affine)
    tasks.perMaterial("mpm::initializeAffineMoment", initializeAffineMoment, problem_.materials, requiresNew(p::mass),
                      computes(p::affineMoment));
  tasks.perMaterial("mpm::startWork", startWork<D>, problem_.materials, requiresNew(p::mass),
                    requiresNew(p::velocity<D>), computes(p::work));
  if (is_damageable_) scheduleInitialDamage(tasks, problem_.materials);
  if (problem_.surroundings) problem_.surroundings->scheduleStart(tasks, problem_.materials);
}

template <class Shape>
void SolidMpm<Shape>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeStableTimeStep", computeStableTimeStep<D>, problem_.materials,
                    requiresOld(c::stableTimeStep), computes(delT));
}

template <class Shape>
void SolidMpm<Shape>::scheduleTimeAdvance(TaskList& tasks) const {
  if (isLoaded()) scheduleApplyExternalLoads(tasks);
  if (hasFriction()) scheduleComputeSurface(tasks);
  switch (problem_.method.stressUpdate) {
    case StressUpdate::last:
      scheduleMomentum(tasks, old);
      problem_.method.sharesVolume ? scheduleUpdateInCells(tasks) : scheduleUpdateParticles(tasks);
      scheduleVelocityUpdate(tasks, old);
      break;
    case StressUpdate::modifiedLast:
      scheduleMomentum(tasks, old);
      scheduleMoveParticles(tasks, old);
      scheduleVelocityUpdate(tasks, old);
      scheduleInterpolateMomentum(tasks, fresh);
      scheduleComputeStressTensor(tasks, g::stressRecord);
      break;
    case StressUpdate::first:
      scheduleInterpolateMomentum(tasks, old);
      scheduleComputeStressTensor(tasks, g::stressRecord);
      scheduleMomentum(tasks, fresh);
      scheduleMoveParticles(tasks, fresh);
      scheduleVelocityUpdate(tasks, fresh);
      break;
  }
  if (problem_.method.maximumParticleVelocity)
    tasks.perMaterial("mpm::limitVelocity", limitVelocity<D>, problem_.materials,
                      with(*problem_.method.maximumParticleVelocity), requiresOld(p::velocity<D>),
                      modifies(p::velocity<D>));
  if (heats_) scheduleHeatOfWork(tasks, problem_.materials, problem_.method.conductsHeat);
  scheduleStrainWork(tasks);
  scheduleNonlocalPlasticity(tasks);
  tasks.perMaterial("mpm::addDisplacement", addDisplacement<D>, problem_.materials, requiresOld(p::x<D>),
                    requiresNew(p::x<D>), requiresOld(p::displacement<D>), computes(p::displacement<D>));
  if (problem_.surroundings && problem_.surroundings->exchangesHeat() && !problem_.method.conductsHeat && !heats_)
    tasks.perMaterial("mpm::keepTemperature", keepTemperature, problem_.materials, requiresOld(p::temperature),
                      computes(p::temperature));
  if (problem_.surroundings) problem_.surroundings->scheduleMotion(tasks, problem_.materials);
  tasks.relocate(p::x<D>, problem_.materials);
}

template <class Shape>
void SolidMpm<Shape>::scheduleApplyExternalLoads(TaskList& tasks) const {
  if (problem_.start.solution)
    tasks.perMaterial("mpm::applyExternalLoads", applyManufacturedForce<D>, problem_.materials,
                      with(problem_.start.solution.get()), startTime(), requiresOld(p::x<D>),
                      requiresOld(p::displacement<D>), requiresOld(p::mass), computes(p::externalForce<D>));
  else if (problem_.method.loadsAtCorners)
    tasks.perMaterial("mpm::applyExternalLoads", applyLoadsAtCorners<D>, problem_.materials, with(problem_.start.loads),
                      with(problem_.method.commonSize), startTime(), all<LoadedParticles<D>>(boxSizes(), 0),
                      computes(p::externalForce<D>));
  else
    tasks.perMaterial("mpm::applyExternalLoads", applyExternalLoads<D>, problem_.materials, with(problem_.start.loads),
                      startTime(), requiresOld(p::x<D>), requiresOld(p::mass), requiresOld(p::loadCurves),
                      when(problem_.method.turnsPressures, requiresOld(p::deformationMeasure)),
                      computes(p::externalForce<D>));
}

template <class Shape>
template <class Reads>
void SolidMpm<Shape>::scheduleMomentum(TaskList& tasks, Reads stressed) const {
  scheduleInterpolateParticlesToGrid(tasks, stressed);
  scheduleIntegrateAcceleration(tasks);
  scheduleMeasureWork(tasks, stressed);
  scheduleHeat(tasks);
}

/// With the forces of the stresses: Uintah's computeInternalForce. `stressed` reads F and the stress.
template <class Shape>
template <class Reads>
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
  if (problem_.method.loadsAtCorners && isLoaded())
    tasks.perMaterial("mpm::addLoadsAtCorners", addLoadsAtCorners<D>, problem_.materials, with(problem_.start.loads),
                      with(problem_.method.commonSize), startTime(),
                      all<LoadedParticles<D>>(boxSizes(), static_cast<int>(cornerReach)), modifies(g::record));
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
void SolidMpm<Shape>::scheduleFriction(TaskList& tasks, const std::string& name, Moment moment,
                                       const NodeLabel<NodeRecord>& record, bool heats) const {
  tasks.acrossMaterials(name, exchangeByFriction<D>, problem_.materials, with(problem_.contacts), with(moment),
                        requiresOld(delT), all<ContactSurface<D>>(), modifies(record),
                        when(heats, computes(g::frictionHeat)));
}

template <class Shape>
void SolidMpm<Shape>::scheduleIntegrateAcceleration(TaskList& tasks) const {
  if (problem_.surroundings) {
    problem_.surroundings->scheduleForces(tasks, problem_.materials);
    tasks.perMaterial("mpm::addSurroundingForce", addSurroundingForce<D>, problem_.materials,
                      requiresNew(g::surroundingForce<D>), modifies(g::record));
  }
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

template <class Shape>
void SolidMpm<Shape>::scheduleKeepVelocity(TaskList& tasks, const NodeLabel<Vec<D>>& kept) const {
  tasks.perMaterial("mpm::keepVelocity", keepVelocity<D>, problem_.materials, requiresNew(g::record), computes(kept));
}

/// Runs only if work is saved or reported, as scheduleStrainWork; `shaped` reads the F that shape functions follow.
template <class Shape>
template <class Reads>
void SolidMpm<Shape>::scheduleMeasureWork(TaskList& tasks, Reads shaped) const {
  tasks.perMaterial("mpm::computeNodalWork", computeNodalWork<D>, problem_.materials, with(problem_.method),
                    requiresOld(delT), requiresNew(g::record), requiresNew(g::velocityOfForces<D>),
                    when(!problem_.contacts.empty(), requiresNew(g::velocityOfContact<D>)), computes(g::workRecord));
  tasks.perMaterial("mpm::measureWork", measureWork<Shape>, problem_.materials, with(problem_.method.commonSize),
                    requiresOld(delT), all<ParticleWork<Shape>>(keeps(), shapedBy(shaped)));
}
template <class Shape>
void SolidMpm<Shape>::scheduleStrainWork(TaskList& tasks) const {
  tasks.perMaterial("mpm::measureStrainWork", measureStrainWork, problem_.materials,
                    all<StrainWork>(keeps(), old, fresh));
  if (keeps_stress_ && state_size_ > 0)
    tasks.perMaterial("mpm::measurePlasticWork", measurePlasticWork, problem_.materials, with(state_size_),
                      requiresOld(state_), requiresNew(state_), requiresNew(p::volume), requiresNew(p::stress),
                      modifies(p::work));
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
  scheduleMoveParticles(tasks, old);
  scheduleComputeStressTensor(tasks, g::record);
}

/// x and v alone; `shaped` reads the F that shape functions follow.
template <class Shape>
template <class Reads>
void SolidMpm<Shape>::scheduleMoveParticles(TaskList& tasks, Reads shaped) const {
  tasks.perMaterial("mpm::interpolateToParticlesAndUpdate", moveParticles<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(delT),
                    all<MotionUpdate<Shape>>(keepsSizes(), shapedBy(shaped)));
}

/// Schedules the update that replaces FLIP's velocity; `shaped` reads the F that shape functions follow.
template <class Shape>
template <class Reads>
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

/// The velocity that stresses follow, where that is not the one of the motion; `moving` reads that of the particles.
template <class Shape>
template <class Reads>
void SolidMpm<Shape>::scheduleInterpolateMomentum(TaskList& tasks, Reads moving) const {
  const int reach = Shape::reach;
  tasks.perMaterial("mpm::interpolateMomentum", interpolateMomentum<Shape>, problem_.materials,
                    with(problem_.method.commonSize),
                    all<MomentumSources<Shape>>(keepsSizes(), moving(p::velocity<D>, reach), shapedBy(old, reach)),
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

/// The mean of the plastic strain around each particle, for the next step.
template <class Shape>
void SolidMpm<Shape>::scheduleNonlocalPlasticity(TaskList& tasks) const {
  const int layers = problem_.method.nonlocalLayers;
  if (layers == 0) return;
  tasks.perMaterial("mpm::findPlasticIncrement", findPlasticIncrement, problem_.materials, with(state_size_),
                    requiresNew(state_), computes(p::plasticIncrement));
  tasks.perMaterial("mpm::averagePlasticIncrement", averagePlasticIncrement<D>, problem_.materials, with(layers),
                    with(state_size_), requiresOld(p::x<D>, layers), requiresOld(p::volume, layers),
                    requiresNew(p::plasticIncrement, layers), modifies(state_));
}

template <class Shape>
void SolidMpm<Shape>::scheduleDamage(TaskList& tasks) const {
  if (is_damageable_) solid::scheduleDamage(tasks, problem_.materials, state_);
}

template <class Shape>
void SolidMpm<Shape>::scheduleDiagnostics(TaskList& tasks) const {
  scheduleTotals<D>(tasks, problem_.materials, problem_.method, keepsSizes());
  for (std::size_t k = 0; k < total::work.size(); ++k)
    tasks.perMaterial("mpm::sumWork", sumWork, problem_.materials, with(static_cast<int>(k)), requiresOld(p::work),
                      computes(total::work[k]));
  if (!is_damageable_)
    tasks.perMaterial("mpm::showSound", showSound, problem_.materials, requiresOld(p::mass), computes(p::localized));
  for (const auto& view : state_views_) view->schedule(tasks, problem_.materials, state_size_, state_);
  if (!keeps_stress_) {
    tasks.perMaterial("mpm::computeVolume", computeVolume, problem_.materials, requiresOld(p::mass, Shape::reach),
                      requiresOld(p::deformationMeasure, Shape::reach), computes(p::volume));
    tasks.perMaterial("mpm::computeStress", computeStress, problem_.materials, requiresOld(p::deformationMeasure),
                      computes(p::stress));
  }
  const auto show = [&](auto reads) {
    scheduleShowOnGrid<Shape>(tasks, problem_.materials, problem_.method.commonSize, keepsSizes(),
                              reads(p::volume, Shape::reach), reads(p::stress, Shape::reach));
    scheduleBoundaryForces<D>(tasks, problem_.materials, problem_.method.isThin, reads(p::volume, 0),
                              reads(p::stress, 0));
    tasks.perMaterial("mpm::sumVolume", sumParticles, problem_.materials, reads(p::volume, 0), computes(total::volume));
  };
  if (keeps_stress_)
    show(old);
  else
    show(fresh);
}

}  // namespace tushar::mpm::solid
