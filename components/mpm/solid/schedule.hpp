#pragma once

#include "components/mpm/solid/solid_mpm.hpp"
#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "components/mpm/solid/tasks/boundary_force.hpp"
#include "components/mpm/solid/tasks/damage.hpp"
#include "components/mpm/solid/tasks/diagnose.hpp"
#include "components/mpm/solid/tasks/exchange_momentum.hpp"
#include "components/mpm/solid/tasks/heat.hpp"
#include "components/mpm/solid/tasks/integrate_acceleration.hpp"
#include "components/mpm/solid/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/tasks/interpolate_to_particles_and_update.hpp"
#include "components/mpm/solid/tasks/show_grid.hpp"
#include "components/mpm/solid/tasks/stable_time_step.hpp"

// The schedule of SolidMpm: included by the files that instantiate it, one for each kind of shape function.

namespace tushar::mpm::solid {

template <class Shape>
SolidMpm<Shape>::SolidMpm(Problem problem) : problem_(std::move(problem)) {
  const auto any = [&](auto&& holds) {
    return std::any_of(problem_.materials.begin(), problem_.materials.end(), [&](const Material& m) { return holds(*m.model); });
  };
  is_damageable_ = std::any_of(problem_.materials.begin(), problem_.materials.end(),
                               [](const Material& material) { return material.isDamageable(); });
  keeps_stress_ = is_damageable_ || any([](const Model& model) { return !model.dependsOnDeformationOnly(); });
  is_thermal_ = any([](const Model& model) { return model.usesTemperature(); });
  heats_ = any([](const Model& model) { return model.heats(); }) || (isViscous() && problem_.method.viscosityHeats);
  for (const Material& material : problem_.materials) state_size_ = std::max(state_size_, material.model->stateSize());
  state_.components = state_size_;
  state_.bytes = static_cast<std::size_t>(state_size_) * sizeof(double);
  state_views_ = stateViews(problem_.materials);
}

template <class Shape>
void SolidMpm<Shape>::scheduleInitialize(TaskList& tasks) const {
  tasks.newParticles("mpm::actuallyInitialize", actuallyInitialize<D>, problem_.materials, with(problem_.start),
                     creates(p::x<D>), creates(p::velocity<D>), creates(p::displacement<D>), creates(p::size<D>),
                     creates(p::externalForce<D>), creates(p::mass), creates(p::temperature), creates(p::color),
                     creates(p::viscosity), creates(p::strainEnergy), creates(p::deformationMeasure),
                     creates(p::velocityGradient), creates(p::loadCurves));
  tasks.perMaterial("mpm::computeInitialTimeStep", computeInitialTimeStep<D>, problem_.materials,
                    requiresNew(p::velocity<D>), requiresNew(p::temperature), computes(c::stableTimeStep));
  if (keeps_stress_)
    tasks.perMaterial("mpm::initializeStress", initializeStress, problem_.materials, with(state_size_),
                      requiresNew(p::mass), requiresNew(p::deformationMeasure), computes(p::volume), computes(p::stress),
                      when(state_size_ > 0, computes(state_)));
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
  scheduleInterpolateParticlesToGrid(tasks);
  scheduleIntegrateAcceleration(tasks);
  scheduleHeat(tasks);
  scheduleUpdateParticles(tasks);
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
                      startTime(), requiresOld(p::x<D>), requiresOld(p::loadCurves), computes(p::externalForce<D>));
}

/// With the forces of the stresses: Uintah's computeInternalForce.
template <class Shape>
void SolidMpm<Shape>::scheduleInterpolateParticlesToGrid(TaskList& tasks) const {
  const int reach = Shape::reach;
  tasks.perMaterial("mpm::interpolateParticlesToGrid", interpolateParticlesToGrid<Shape>, problem_.materials,
                    with(problem_.method.commonSize), with(!problem_.contacts.empty()), requiresOld(p::x<D>, reach),
                    when(keepsSizes(), requiresOld(p::size<D>, reach)), requiresOld(p::mass, reach),
                    requiresOld(p::velocity<D>, reach),
                    when(!keeps_stress_ || Shape::deforms, requiresOld(p::deformationMeasure, reach)),
                    when(keeps_stress_, requiresOld(p::volume, reach)),
                    when(keeps_stress_, requiresOld(p::stress, reach)),
                    when(isViscous(), requiresOld(p::viscosity, reach)),
                    when(isLoaded(), requiresNew(p::externalForce<D>, reach)), computes(g::record));
  if (!problem_.contacts.empty())
    tasks.acrossMaterials("mpm::exMomInterpolated", exMomInterpolated<D>, problem_.materials, with(problem_.contacts),
                          modifies(g::record));
}

template <class Shape>
void SolidMpm<Shape>::scheduleIntegrateAcceleration(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeAndIntegrateAcceleration", computeAndIntegrateAcceleration<Shape>, problem_.materials,
                    with(problem_.method), requiresOld(p::x<D>, Shape::reach), requiresOld(delT), modifies(g::record));
  if (!problem_.contacts.empty())
    tasks.acrossMaterials("mpm::exMomIntegrated", exMomIntegrated<D>, problem_.materials, with(problem_.contacts),
                          startTime(), requiresOld(delT), modifies(g::record), computes(total::rigidReactionForce));
  tasks.perMaterial("mpm::setGridBoundaryConditions", setGridBoundaryConditions<D>, problem_.materials,
                    modifies(g::record));
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
  tasks.perMaterial("mpm::computeInternalHeatRate", computeInternalHeatRate<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>, reach),
                    when(keepsSizes(), requiresOld(p::size<D>, reach)), requiresOld(p::deformationMeasure, reach),
                    requiresOld(p::mass, reach), requiresNew(g::temperature, reach + Shape::ghostNodes),
                    computes(g::heatRate));
  if (touching)
    tasks.acrossMaterials("mpm::computeHeatExchange", computeHeatExchange<D>, problem_.materials,
                          requiresNew(g::heatCapacity), requiresNew(g::temperature), requiresOld(delT),
                          computes(g::contactTemperatureRate));
  tasks.perMaterial("mpm::integrateTemperatureRate", integrateTemperatureRate<D>, problem_.materials,
                    requiresNew(g::heatCapacity), requiresNew(g::temperatureNoBC), requiresNew(g::temperature),
                    requiresNew(g::heatRate), when(touching, requiresNew(g::contactTemperatureRate)), requiresOld(delT),
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
      when(hasState, requiresOld(state_)), when(is_damageable_, requiresOld(p::localized)), computes(p::x<D>), computes(p::velocity<D>), computes(p::deformationMeasure),
      when(keeps_stress_, computes(p::volume)), when(keeps_stress_, computes(p::stress)),
      when(hasState, computes(state_)), when(isViscous(), computes(p::viscosity)),
      when(problem_.method.strainEnergy, computes(p::strainEnergy)), when(heats_, computes(p::temperatureChange)),
      when(problem_.method.velocityGradient, computes(p::velocityGradient)), computes(c::stableTimeStep));
  if (is_damageable_)
    tasks.perMaterial("mpm::computeDamage", computeDamage, problem_.materials, with(state_size_), startTime(),
                      requiresOld(delT), requiresOld(p::temperature), requiresOld(p::damage),
                      requiresOld(p::failureThreshold), requiresOld(p::localized), requiresOld(p::failureTime),
                      requiresNew(p::deformationMeasure), requiresNew(p::volume), when(hasState, requiresNew(state_)),
                      modifies(p::stress), computes(p::damage), computes(p::failureThreshold), computes(p::localized),
                      computes(p::failureTime));
  if (heats_ && problem_.method.conductsHeat)
    tasks.perMaterial("mpm::finalParticleUpdate", addWorkOfStep, problem_.materials, requiresNew(p::temperatureChange),
                      modifies(p::temperature));
  else if (heats_)
    tasks.perMaterial("mpm::finalParticleUpdate", heatByWorkOfStep, problem_.materials,
                      requiresNew(p::temperatureChange), requiresOld(p::temperature), computes(p::temperature));
  tasks.perMaterial("mpm::addDisplacement", addDisplacement<D>, problem_.materials, requiresOld(p::x<D>),
                    requiresNew(p::x<D>), requiresOld(p::displacement<D>), computes(p::displacement<D>));
}

template <class Shape>
void SolidMpm<Shape>::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perMaterial("mpm::sumMass", sumParticles, problem_.materials, requiresOld(p::mass), computes(total::mass));
  tasks.perMaterial("mpm::sumStrainEnergy", sumParticles, problem_.materials, requiresOld(p::strainEnergy),
                    computes(total::strainEnergy));
  tasks.perMaterial("mpm::sumKineticEnergy", sumKineticEnergy<D>, problem_.materials, requiresOld(p::mass),
                    requiresOld(p::velocity<D>), computes(total::kineticEnergy));
  tasks.perMaterial("mpm::sumMomentum", sumMomentum<D>, problem_.materials, requiresOld(p::mass),
                    requiresOld(p::velocity<D>), computes(total::momentum));
  tasks.perMaterial("mpm::sumCenterOfMass", sumCenterOfMass<D>, problem_.materials, requiresOld(p::mass),
                    requiresOld(p::x<D>), computes(total::centerOfMass));
  for (const auto& view : state_views_) view->schedule(tasks, problem_.materials, state_size_, state_);
  if (!keeps_stress_) {
    tasks.perMaterial("mpm::computeVolume", computeVolume, problem_.materials, requiresOld(p::mass, Shape::reach),
                      requiresOld(p::deformationMeasure, Shape::reach), computes(p::volume));
    tasks.perMaterial("mpm::computeStress", computeStress, problem_.materials, requiresOld(p::deformationMeasure),
                      computes(p::stress));
  }
  const auto show = [&](const auto& volume, const auto& stress) {
    tasks.perMaterial("mpm::showOnGrid", showOnGrid<Shape>, problem_.materials, with(problem_.method.commonSize),
                      requiresOld(p::x<D>, Shape::reach), when(keepsSizes(), requiresOld(p::size<D>, Shape::reach)),
                      requiresOld(p::deformationMeasure, Shape::reach), requiresOld(p::mass, Shape::reach),
                      requiresOld(p::velocity<D>, Shape::reach), volume, stress, computes(g::mass), computes(g::volume),
                      computes(g::velocity<D>), computes(g::internalForce<D>), computes(g::acceleration<D>),
                      computes(g::stress));
  };
  const auto measure = [&](const auto& volume, const auto& stress) {
    for (int face = 0; face < 6; ++face) {
      const auto k = static_cast<std::size_t>(face);
      if (problem_.method.isThin[k / 2])
        tasks.perMaterial("mpm::measureThinBoundary", measureThinBoundary, problem_.materials, with(face), volume,
                          stress, computes(total::boundaryForce[k]), computes(total::contactArea[k]));
      else
        tasks.perMaterial("mpm::measureBoundary", measureBoundary<D>, problem_.materials, with(face),
                          requiresNew(g::internalForce<D>), requiresNew(g::volume), computes(total::boundaryForce[k]),
                          computes(total::contactArea[k]));
    }
  };
  if (keeps_stress_) {
    show(requiresOld(p::volume, Shape::reach), requiresOld(p::stress, Shape::reach));
    measure(requiresOld(p::volume), requiresOld(p::stress));
  } else {
    show(requiresNew(p::volume, Shape::reach), requiresNew(p::stress, Shape::reach));
    measure(requiresNew(p::volume), requiresNew(p::stress));
  }
}

}  // namespace tushar::mpm::solid
