#pragma once

#include "components/mpm/solid/solid_mpm.hpp"
#include "components/mpm/solid/tasks/affine.hpp"
#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "components/mpm/solid/tasks/boundary_force.hpp"
#include "components/mpm/solid/tasks/damage.hpp"
#include "components/mpm/solid/tasks/diagnose.hpp"
#include "components/mpm/solid/tasks/exchange_momentum.hpp"
#include "components/mpm/solid/tasks/friction.hpp"
#include "components/mpm/solid/tasks/heat.hpp"
#include "components/mpm/solid/tasks/integrate_acceleration.hpp"
#include "components/mpm/solid/tasks/interpolate_momentum.hpp"
#include "components/mpm/solid/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/tasks/interpolate_to_particles_and_update.hpp"
#include "components/mpm/solid/tasks/show_grid.hpp"
#include "components/mpm/solid/tasks/stable_time_step.hpp"
#include "components/mpm/solid/tasks/update_in_parts.hpp"
#include "components/mpm/solid/tasks/velocity_updates.hpp"

// The schedule of SolidMpm: included by the files that instantiate it, one for each kind of shape function.

namespace tushar::mpm::solid {

/// What a task may be given to read variables with: as they were at the start of the step, or as the step has them.
inline constexpr auto old = [](const auto& label, int ghost) { return requiresOld(label, ghost); };
inline constexpr auto fresh = [](const auto& label, int ghost) { return requiresNew(label, ghost); };

template <class Shape>
SolidMpm<Shape>::SolidMpm(Problem problem) : Solids(std::move(problem)) {
  const auto any = [&](auto&& holds) {
    return std::any_of(problem_.materials.begin(), problem_.materials.end(), [&](const Material& m) { return holds(*m.model); });
  };
  is_damageable_ = std::any_of(problem_.materials.begin(), problem_.materials.end(),
                               [](const Material& material) { return material.isDamageable(); });
  keeps_stress_ = is_damageable_ || any([](const Model& model) { return !model.dependsOnDeformationOnly(); });
  is_thermal_ = any([](const Model& model) { return model.usesTemperature(); });
  heats_ = any([](const Model& model) { return model.heats(); });
}

template <class Shape>
void SolidMpm<Shape>::scheduleInitialize(TaskList& tasks) const {
  scheduleActuallyInitialize<D>(tasks, problem_.materials, problem_.start);
  tasks.perMaterial("mpm::computeInitialTimeStep", computeInitialTimeStep<D>, problem_.materials,
                    requiresNew(p::velocity<D>), requiresNew(p::temperature), requiresNew(p::deformationMeasure),
                    computes(c::stableTimeStep));
  if (keeps_stress_)
    tasks.perMaterial("mpm::initializeStress", initializeStress, problem_.materials, with(state_size_),
                      requiresNew(p::mass), requiresNew(p::deformationMeasure), computes(p::volume), computes(p::stress),
                      when(state_size_ > 0, computes(state_)));
  if (problem_.method.affine)
    tasks.perMaterial("mpm::initializeAffineMoment", initializeAffineMoment, problem_.materials, requiresNew(p::mass),
                      computes(p::affineMoment));
  if (is_damageable_)
    tasks.perMaterial("mpm::initializeDamage", initializeDamage, problem_.materials, requiresNew(data::particleId),
                      requiresNew(p::volume), computes(p::damage), computes(p::failureThreshold),
                      computes(p::localized), computes(p::failureTime));
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
      scheduleUpdateParticles(tasks);
      scheduleVelocityUpdate(tasks, old);
      break;
    case StressUpdate::modifiedLast:
      scheduleMomentum(tasks, old);
      scheduleMoveParticles(tasks, old);
      scheduleVelocityUpdate(tasks, old);
      scheduleComputeStressTensor(tasks, fresh);
      break;
    case StressUpdate::first:
      scheduleComputeStressTensor(tasks, old);
      scheduleMomentum(tasks, fresh);
      scheduleMoveParticles(tasks, fresh);
      scheduleVelocityUpdate(tasks, fresh);
      break;
  }
  if (problem_.method.maximumParticleVelocity)
    tasks.perMaterial("mpm::limitVelocity", limitVelocity<D>, problem_.materials,
                      with(*problem_.method.maximumParticleVelocity), requiresOld(p::velocity<D>),
                      modifies(p::velocity<D>));
  scheduleHeating(tasks);
  tasks.perMaterial("mpm::addDisplacement", addDisplacement<D>, problem_.materials, requiresOld(p::x<D>),
                    requiresNew(p::x<D>), requiresOld(p::displacement<D>), computes(p::displacement<D>));
  tasks.relocate(p::x<D>, problem_.materials);
}

template <class Shape>
void SolidMpm<Shape>::scheduleApplyExternalLoads(TaskList& tasks) const {
  if (problem_.start.solution)
    tasks.perMaterial("mpm::applyExternalLoads", applyManufacturedForce<D>, problem_.materials,
                      with(problem_.start.solution.get()), startTime(), requiresOld(p::x<D>),
                      requiresOld(p::displacement<D>), requiresOld(p::mass), computes(p::externalForce<D>));
  else
    tasks.perMaterial("mpm::applyExternalLoads", applyExternalLoads<D>, problem_.materials, with(problem_.start.loads),
                      startTime(), requiresOld(p::x<D>), requiresOld(p::mass), requiresOld(p::loadCurves),
                      computes(p::externalForce<D>));
}

template <class Shape>
template <class Reads>
void SolidMpm<Shape>::scheduleMomentum(TaskList& tasks, Reads stressed) const {
  scheduleInterpolateParticlesToGrid(tasks, stressed);
  scheduleIntegrateAcceleration(tasks);
  scheduleHeat(tasks);
}

/// With the forces of the stresses: Uintah's computeInternalForce. `stressed` reads F and the stress.
template <class Shape>
template <class Reads>
void SolidMpm<Shape>::scheduleInterpolateParticlesToGrid(TaskList& tasks, Reads stressed) const {
  const int reach = Shape::reach;
  tasks.perMaterial("mpm::interpolateParticlesToGrid", interpolateParticlesToGrid<Shape>, problem_.materials,
                    with(problem_.method.commonSize), with(!problem_.contacts.empty()), requiresOld(p::x<D>, reach),
                    when(keepsSizes(), requiresOld(p::size<D>, reach)), requiresOld(p::mass, reach),
                    requiresOld(p::velocity<D>, reach),
                    when(!keeps_stress_ || Shape::deforms, stressed(p::deformationMeasure, reach)),
                    when(keeps_stress_, stressed(p::volume, reach)), when(keeps_stress_, stressed(p::stress, reach)),
                    when(isViscous(), stressed(p::viscosity, reach)),
                    when(isLoaded(), requiresNew(p::externalForce<D>, reach)), computes(g::record));
  if constexpr (!Shape::deforms && !Shape::axisymmetric)
    if (problem_.method.affine)
      tasks.perMaterial("mpm::addAffineVelocity", addAffineVelocity<Shape>, problem_.materials, with(problem_.method),
                        requiresOld(p::x<D>, reach), when(keepsSizes(), requiresOld(p::size<D>, reach)),
                        requiresOld(p::mass, reach), requiresOld(p::affineMoment, reach), modifies(g::record));
  if (!problem_.contacts.empty())
    tasks.acrossMaterials("mpm::exMomInterpolated", exMomInterpolated<D>, problem_.materials, with(problem_.contacts),
                          startTime(), modifies(g::record));
  if (hasFriction()) scheduleFriction(tasks, "mpm::frictionInterpolated", Moment::start, g::record);
}

template <class Shape>
void SolidMpm<Shape>::scheduleComputeSurface(TaskList& tasks) const {
  const int reach = Shape::reach;
  tasks.perMaterial("mpm::computeSurface", computeSurface<Shape>, problem_.materials, with(problem_.method.commonSize),
                    requiresOld(p::x<D>, reach), when(keepsSizes(), requiresOld(p::size<D>, reach)),
                    requiresOld(p::mass, reach), requiresOld(p::deformationMeasure, reach),
                    when(keeps_stress_, requiresOld(p::stress, reach)), computes(g::massGradient<D>),
                    computes(g::massPosition<D>), computes(g::surfaceStress), computes(g::surfaceVolume));
}

template <class Shape>
void SolidMpm<Shape>::scheduleFriction(TaskList& tasks, const std::string& name, Moment moment,
                                       const NodeLabel<Octet>& record) const {
  tasks.acrossMaterials(name, applyFriction<D>, problem_.materials, with(problem_.contacts), with(moment),
                        requiresOld(delT), requiresNew(g::massGradient<D>), requiresNew(g::massPosition<D>),
                        requiresNew(g::surfaceStress), requiresNew(g::surfaceVolume), modifies(record));
}
/// At the end of the step.
template <class Shape>
void SolidMpm<Shape>::scheduleHeatingFriction(TaskList& tasks) const {
  tasks.acrossMaterials("mpm::frictionIntegrated", applyHeatingFriction<D>, problem_.materials, with(problem_.contacts),
                        requiresOld(delT), requiresNew(g::massGradient<D>), requiresNew(g::massPosition<D>),
                        requiresNew(g::surfaceStress), requiresNew(g::surfaceVolume), modifies(g::record),
                        computes(g::frictionHeat));
}

template <class Shape>
void SolidMpm<Shape>::scheduleIntegrateAcceleration(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeAndIntegrateAcceleration", computeAndIntegrateAcceleration<Shape>, problem_.materials,
                    with(problem_.method), requiresOld(p::x<D>, Shape::reach), requiresOld(delT), modifies(g::record));
  if (!problem_.contacts.empty())
    tasks.acrossMaterials("mpm::exMomIntegrated", exMomIntegrated<D>, problem_.materials, with(problem_.contacts),
                          with(Acceleration{problem_.method.gravity, problem_.method.damping}), startTime(),
                          requiresOld(delT), modifies(g::record), computes(total::rigidReactionForce));
  if (rubbingHeats())
    scheduleHeatingFriction(tasks);
  else if (hasFriction())
    scheduleFriction(tasks, "mpm::frictionIntegrated", Moment::end, g::record);
  tasks.perMaterial("mpm::setGridBoundaryConditions", setGridBoundaryConditions<Shape>, problem_.materials,
                    requiresOld(p::x<D>, Shape::reach), modifies(g::record));
}

/// Only run where someone reads or saves the temperature.
template <class Shape>
void SolidMpm<Shape>::scheduleHeat(TaskList& tasks) const {
  if (!problem_.method.conductsHeat) return;
  const int reach = Shape::reach;
  const bool touching = problem_.method.thermalContact;
  tasks.perMaterial("mpm::interpolateTemperatureToGrid", interpolateTemperatureToGrid<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>, reach),
                    when(keepsSizes(), requiresOld(p::size<D>, reach)), requiresOld(p::deformationMeasure, reach),
                    requiresOld(p::mass, reach), requiresOld(p::temperature, reach), computes(g::heatCapacity),
                    computes(g::temperatureNoBC), computes(g::temperature));
  const bool heated = problem_.start.loads.hasHeat();
  if (heated)
    tasks.perMaterial("mpm::applyHeatFlux", applyHeatFlux<D>, problem_.materials, with(problem_.start.loads), startTime(),
                      requiresOld(p::x<D>), requiresOld(p::loadCurves), computes(p::heatFlux));
  tasks.perMaterial("mpm::computeInternalHeatRate", computeInternalHeatRate<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>, reach),
                    when(keepsSizes(), requiresOld(p::size<D>, reach)), requiresOld(p::deformationMeasure, reach),
                    requiresOld(p::mass, reach), when(heated, requiresNew(p::heatFlux, reach)),
                    requiresNew(g::temperature, reach + Shape::ghostNodes), computes(g::heatRate));
  if (touching)
    tasks.acrossMaterials("mpm::computeHeatExchange", computeHeatExchange<D>, problem_.materials,
                          requiresNew(g::heatCapacity), requiresNew(g::temperature), requiresOld(delT),
                          computes(g::contactTemperatureRate));
  tasks.perMaterial("mpm::integrateTemperatureRate", integrateTemperatureRate<D>, problem_.materials,
                    requiresNew(g::heatCapacity), requiresNew(g::temperatureNoBC), requiresNew(g::temperature),
                    requiresNew(g::heatRate), when(touching, requiresNew(g::contactTemperatureRate)),
                    when(rubbingHeats(), requiresNew(g::frictionHeat)), requiresOld(delT),
                    computes(g::temperatureRate));
  tasks.perMaterial("mpm::updateTemperature", updateTemperature<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>), when(keepsSizes(), requiresOld(p::size<D>)),
                    requiresOld(p::deformationMeasure), requiresOld(p::temperature),
                    requiresNew(g::temperatureRate, Shape::ghostNodes), requiresOld(delT), computes(p::temperature));
}

/// With the gradients and the stresses: Uintah's computeParticleGradients and computeStressTensor.
template <class Shape>
void SolidMpm<Shape>::scheduleUpdateParticles(TaskList& tasks) const {
  const bool hasState = state_size_ > 0;
  tasks.perMaterial(
      "mpm::interpolateToParticlesAndUpdate", interpolateToParticlesAndUpdate<Shape>, problem_.materials,
      with(problem_.method), with(state_size_), requiresOld(delT), requiresNew(g::record, Shape::storedNodes),
      requiresOld(p::x<D>), when(keepsSizes(), requiresOld(p::size<D>)), requiresOld(p::velocity<D>),
      requiresOld(p::mass), requiresOld(p::deformationMeasure), when(is_thermal_, requiresOld(p::temperature)),
      when(keeps_stress_, requiresOld(p::volume)), when(keeps_stress_, requiresOld(p::stress)),
      when(hasState, requiresOld(state_)), when(is_damageable_, requiresOld(p::localized)), computes(p::x<D>),
      computes(p::velocity<D>), computes(p::deformationMeasure),
      when(keeps_stress_, computes(p::volume)), when(keeps_stress_, computes(p::stress)),
      when(hasState, computes(state_)), when(isViscous(), computes(p::viscosity)),
      when(problem_.method.strainEnergy, computes(p::strainEnergy)), when(heats_, computes(p::temperatureChange)),
      when(problem_.method.velocityGradient, computes(p::velocityGradient)), computes(c::stableTimeStep));
  scheduleDamage(tasks);
}

/// x and v alone; `shaped` reads the F that shape functions follow.
template <class Shape>
template <class Reads>
void SolidMpm<Shape>::scheduleMoveParticles(TaskList& tasks, Reads shaped) const {
  tasks.perMaterial("mpm::interpolateToParticlesAndUpdate", moveParticles<Shape>, problem_.materials,
                    with(problem_.method), requiresOld(delT), requiresNew(g::record, Shape::storedNodes),
                    requiresOld(p::x<D>), when(keepsSizes(), requiresOld(p::size<D>)), requiresOld(p::velocity<D>),
                    when(Shape::deforms, shaped(p::deformationMeasure, 0)), computes(p::x<D>), computes(p::velocity<D>));
}

/// What replaces FLIP's velocity; `shaped` reads the F that shape functions follow.
template <class Shape>
template <class Reads>
void SolidMpm<Shape>::scheduleVelocityUpdate(TaskList& tasks, Reads shaped) const {
  const auto shape = when(Shape::deforms, shaped(p::deformationMeasure, 0));
  const auto sizes = when(keepsSizes(), requiresOld(p::size<D>));
  const auto record = requiresNew(g::record, Shape::storedNodes);
  const auto& [materials, method] = std::tie(problem_.materials, problem_.method);
  if (method.picFraction > 0)
    tasks.perMaterial("mpm::blendVelocity", blendVelocity<Shape>, materials, with(method), record, requiresOld(p::x<D>),
                      sizes, shape, modifies(p::velocity<D>));
  if (method.xpic) {
    const int reach = Shape::reach;
    tasks.perMaterial("mpm::computeSSPlusVp", computeSSPlusVp<Shape>, materials, with(method), record,
                      requiresOld(p::x<D>), sizes, shape, computes(p::smoothVelocity<D>));
    tasks.perMaterial("mpm::computeSPlusSSPlusVp", interpolateMomentum<Shape>, materials, with(method.commonSize),
                      requiresOld(p::x<D>, reach), when(keepsSizes(), requiresOld(p::size<D>, reach)),
                      requiresOld(p::mass, reach), when(Shape::deforms, shaped(p::deformationMeasure, reach)),
                      requiresNew(p::smoothVelocity<D>, reach), computes(g::smoothRecord));
    tasks.perMaterial("mpm::applyXpic", applyXpic<Shape>, materials, with(method), requiresOld(delT),
                      requiresNew(g::smoothRecord, Shape::storedNodes), requiresOld(p::x<D>), sizes, shape,
                      requiresOld(p::velocity<D>), requiresNew(p::smoothVelocity<D>), modifies(p::x<D>),
                      modifies(p::velocity<D>));
  }
  if constexpr (!Shape::deforms && !Shape::axisymmetric)
    if (method.affine)
      tasks.perMaterial("mpm::updateAffineMoment", updateAffineMoment<Shape>, materials, with(method), record,
                        requiresOld(p::x<D>), sizes, computes(p::affineMoment));
}

/// F and the stress, apart from the motion; `moving` reads the velocity that they follow.
template <class Shape>
template <class Reads>
void SolidMpm<Shape>::scheduleComputeStressTensor(TaskList& tasks, Reads moving) const {
  const int reach = Shape::reach;
  const bool hasState = state_size_ > 0;
  tasks.perMaterial("mpm::interpolateMomentum", interpolateMomentum<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>, reach),
                    when(keepsSizes(), requiresOld(p::size<D>, reach)), requiresOld(p::mass, reach),
                    when(Shape::deforms, requiresOld(p::deformationMeasure, reach)), moving(p::velocity<D>, reach),
                    computes(g::stressRecord));
  if (!problem_.contacts.empty())
    tasks.acrossMaterials("mpm::exMomOfStresses", exMomOfStresses<D>, problem_.materials, with(problem_.contacts),
                          startTime(), modifies(g::stressRecord));
  if (hasFriction()) scheduleFriction(tasks, "mpm::frictionOfStresses", Moment::end, g::stressRecord);
  tasks.perMaterial("mpm::setGridBoundaryConditionsOfStresses", setGridBoundaryConditions<Shape>, problem_.materials,
                    requiresOld(p::x<D>, reach), modifies(g::stressRecord));
  tasks.perMaterial(
      "mpm::computeStressTensor", computeStressTensor<Shape>, problem_.materials, with(problem_.method),
      with(state_size_), requiresOld(delT), requiresNew(g::stressRecord, Shape::storedNodes), requiresOld(p::x<D>),
      when(keepsSizes(), requiresOld(p::size<D>)), requiresOld(p::velocity<D>), requiresOld(p::mass),
      requiresOld(p::deformationMeasure), when(is_thermal_, requiresOld(p::temperature)),
      when(keeps_stress_, requiresOld(p::volume)), when(keeps_stress_, requiresOld(p::stress)),
      when(hasState, requiresOld(state_)), when(is_damageable_, requiresOld(p::localized)),
      computes(p::deformationMeasure), when(keeps_stress_, computes(p::volume)),
      when(keeps_stress_, computes(p::stress)), when(hasState, computes(state_)),
      when(isViscous(), computes(p::viscosity)), when(problem_.method.strainEnergy, computes(p::strainEnergy)),
      when(heats_, computes(p::temperatureChange)),
      when(problem_.method.velocityGradient, computes(p::velocityGradient)), computes(c::stableTimeStep));
  scheduleDamage(tasks);
}

/// What the stress has left of a particle.
template <class Shape>
void SolidMpm<Shape>::scheduleDamage(TaskList& tasks) const {
  if (is_damageable_)
    tasks.perMaterial("mpm::computeDamage", computeDamage, problem_.materials, with(state_size_), startTime(),
                      requiresOld(delT), requiresOld(p::temperature), requiresOld(p::damage),
                      requiresOld(p::failureThreshold), requiresOld(p::localized), requiresOld(p::failureTime),
                      requiresNew(p::deformationMeasure), requiresNew(p::volume), when(state_size_ > 0, requiresNew(state_)),
                      modifies(p::stress), computes(p::damage), computes(p::failureThreshold), computes(p::localized),
                      computes(p::failureTime));
}

/// The heat of a step's work, once conduction has had its share.
template <class Shape>
void SolidMpm<Shape>::scheduleHeating(TaskList& tasks) const {
  if (heats_ && problem_.method.conductsHeat)
    tasks.perMaterial("mpm::finalParticleUpdate", addWorkOfStep, problem_.materials, requiresNew(p::temperatureChange),
                      modifies(p::temperature));
  else if (heats_)
    tasks.perMaterial("mpm::finalParticleUpdate", heatByWorkOfStep, problem_.materials,
                      requiresNew(p::temperatureChange), requiresOld(p::temperature), computes(p::temperature));
}

template <class Shape>
void SolidMpm<Shape>::scheduleDiagnostics(TaskList& tasks) const {
  scheduleTotals<D>(tasks, problem_.materials, when(problem_.method.affine, requiresOld(p::affineMoment)));
  tasks.perMaterial("mpm::computeScaleFactor", computeScaleFactor<D>, problem_.materials, with(problem_.method.commonSize),
                    when(keepsSizes(), requiresOld(p::size<D>)), requiresOld(p::deformationMeasure),
                    computes(p::scaleFactor));
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
    scheduleShowOnGrid<Shape>(tasks, problem_.materials, problem_.method.commonSize,
                              when(keepsSizes(), requiresOld(p::size<D>, Shape::reach)), reads(p::volume, Shape::reach),
                              reads(p::stress, Shape::reach));
    scheduleBoundaryForces<D>(tasks, problem_.materials, problem_.method.isThin, reads(p::volume, 0), reads(p::stress, 0));
    tasks.perMaterial("mpm::sumVolume", sumParticles, problem_.materials, reads(p::volume, 0), computes(total::volume));
  };
  if (keeps_stress_)
    show(old);
  else
    show(fresh);
}

}  // namespace tushar::mpm::solid
