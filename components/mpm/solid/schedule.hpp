#pragma once

#include "components/mpm/solid/solid_mpm.hpp"

#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "components/mpm/solid/tasks/compute_internal_force.hpp"
#include "components/mpm/solid/tasks/compute_particle_gradients.hpp"
#include "components/mpm/solid/tasks/compute_stress.hpp"
#include "components/mpm/solid/tasks/create_particles.hpp"
#include "components/mpm/solid/tasks/diagnose.hpp"
#include "components/mpm/solid/tasks/exchange_momentum.hpp"
#include "components/mpm/solid/tasks/heat.hpp"
#include "components/mpm/solid/tasks/integrate_acceleration.hpp"
#include "components/mpm/solid/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/tasks/update_particles.hpp"

// The schedule of SolidMpm: included by the files that instantiate it, one for each kind of shape function.

namespace tushar::mpm::solid {

/// Accesses that only some shape functions need.
template <class Shape>
auto requiresSize(int ghost) {
  if constexpr (Shape::hasSize)
    return requiresOld(p::size<Shape::dimension>, ghost);
  else
    return with(Nothing{});
}
template <class Shape>
auto requiresDeformation(int ghost) {
  if constexpr (Shape::deforms)
    return requiresOld(p::deformationMeasure, ghost);
  else
    return with(Nothing{});
}

/// Calls `body(std::bool_constant)`, so that what a scene asks for picks among instances of a task.
template <class Body>
void choose(bool on, Body&& body) {
  on ? body(std::true_type{}) : body(std::false_type{});
}
template <class On, class Access>
auto onlyIf(On, Access access) {
  if constexpr (On::value)
    return access;
  else
    return with(Nothing{});
}

template <class Shape>
bool SolidMpm<Shape>::isThermal() const {
  return std::any_of(problem_.materials.begin(), problem_.materials.end(),
                     [](const Material& material) { return material.model->usesTemperature(); });
}

template <class Shape>
void SolidMpm<Shape>::scheduleInitialize(TaskList& tasks) const {
  tasks.newParticles("mpm::actuallyInitialize", actuallyInitialize<D>, problem_.materials, with(problem_.start), creates(p::x<D>),
                     creates(p::velocity<D>), creates(p::displacement<D>), creates(p::size<D>), creates(p::mass),
                     creates(p::volume), creates(p::temperature), creates(p::color), creates(p::deformationMeasure),
                     creates(p::stress), creates(p::viscosity), creates(p::strainEnergy), creates(p::loadCurves));
  tasks.perMaterial("mpm::computeInitialTimeStep", computeInitialTimeStep<D>, problem_.materials, requiresNew(p::velocity<D>),
                    requiresNew(p::temperature), computes(c::stableTimeStep));
}

template <class Shape>
void SolidMpm<Shape>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeStableTimeStep", computeStableTimeStep<D>, problem_.materials, requiresOld(c::stableTimeStep),
                    computes(delT));
}

template <class Shape>
void SolidMpm<Shape>::scheduleTimeAdvance(TaskList& tasks) const {
  if (isLoaded()) scheduleApplyExternalLoads(tasks);
  scheduleInterpolateParticlesToGrid(tasks);
  scheduleComputeInternalForce(tasks);
  scheduleIntegrateAcceleration(tasks);
  scheduleHeat(tasks);
  scheduleUpdateParticles(tasks);
  scheduleComputeStressTensor(tasks);
  tasks.relocate(p::x<D>, problem_.materials);
}

template <class Shape>
void SolidMpm<Shape>::scheduleInterpolateParticlesToGrid(TaskList& tasks) const {
  tasks.perMaterial("mpm::interpolateParticlesToGrid", interpolateParticlesToGrid<Shape>, problem_.materials,
                    requiresOld(p::x<D>, Shape::reach), requiresSize<Shape>(Shape::reach),
                    requiresDeformation<Shape>(Shape::reach), requiresOld(p::mass, Shape::reach),
                    requiresOld(p::velocity<D>, Shape::reach), computes(g::mass), computes(g::velocity<D>));
  if (!problem_.contacts.empty())
    tasks.acrossMaterials("mpm::exMomInterpolated", exMomInterpolated<D>, problem_.materials, with(problem_.contacts),
                          requiresNew(g::mass), modifies(g::velocity<D>));
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
  tasks.perMaterial("mpm::interpolateExternalForceToGrid", interpolateExternalForceToGrid<Shape>, problem_.materials,
                    requiresOld(p::x<D>, Shape::reach), requiresSize<Shape>(Shape::reach),
                    requiresDeformation<Shape>(Shape::reach), requiresNew(p::externalForce<D>, Shape::reach),
                    computes(g::externalForce<D>));
}

template <class Shape>
void SolidMpm<Shape>::scheduleComputeInternalForce(TaskList& tasks) const {
  choose(isViscous(), [&](auto viscous) {
    tasks.perMaterial("mpm::computeInternalForce", computeInternalForce<Shape, viscous.value>, problem_.materials,
                      requiresOld(p::x<D>, Shape::reach), requiresSize<Shape>(Shape::reach),
                      requiresDeformation<Shape>(Shape::reach), requiresOld(p::volume, Shape::reach),
                      requiresOld(p::stress, Shape::reach), onlyIf(viscous, requiresOld(p::viscosity, Shape::reach)),
                      computes(g::internalForce<D>));
  });
}

template <class Shape>
void SolidMpm<Shape>::scheduleIntegrateAcceleration(TaskList& tasks) const {
  choose(isLoaded(), [&](auto loaded) {
    tasks.perMaterial("mpm::computeAndIntegrateAcceleration", computeAndIntegrateAcceleration<D, loaded.value>,
                      problem_.materials, with(problem_.method), requiresNew(g::mass), requiresNew(g::internalForce<D>),
                      onlyIf(loaded, requiresNew(g::externalForce<D>)), requiresNew(g::velocity<D>), requiresOld(delT),
                      computes(g::velocityStar<D>));
  });
  if (!problem_.contacts.empty())
    tasks.acrossMaterials("mpm::exMomIntegrated", exMomIntegrated<D>, problem_.materials, with(problem_.contacts),
                          startTime(), requiresNew(g::mass), modifies(g::velocityStar<D>));
  tasks.perMaterial("mpm::setGridBoundaryConditions", setGridBoundaryConditions<D>, problem_.materials,
                    requiresNew(g::velocity<D>), requiresOld(delT), modifies(g::velocityStar<D>),
                    computes(g::acceleration<D>));
}

/// Only run where someone reads or saves the temperature.
template <class Shape>
void SolidMpm<Shape>::scheduleHeat(TaskList& tasks) const {
  if (!problem_.method.conductsHeat) return;
  tasks.perMaterial("mpm::interpolateTemperatureToGrid", interpolateTemperatureToGrid<Shape>, problem_.materials,
                    requiresOld(p::x<D>, Shape::reach), requiresSize<Shape>(Shape::reach),
                    requiresDeformation<Shape>(Shape::reach), requiresOld(p::mass, Shape::reach),
                    requiresOld(p::temperature, Shape::reach), requiresNew(g::mass), computes(g::temperatureNoBC),
                    computes(g::temperature));
  tasks.perMaterial("mpm::computeInternalHeatRate", computeInternalHeatRate<Shape>, problem_.materials,
                    requiresOld(p::x<D>, Shape::reach), requiresSize<Shape>(Shape::reach),
                    requiresDeformation<Shape>(Shape::reach), requiresOld(p::volume, Shape::reach),
                    requiresNew(g::temperature, Shape::reach + Shape::ghostNodes), computes(g::heatRate));
  if (problem_.method.thermalContact)
    tasks.acrossMaterials("mpm::computeHeatExchange", computeHeatExchange<D>, problem_.materials, requiresNew(g::mass),
                          requiresNew(g::temperature), requiresOld(delT), computes(g::contactTemperatureRate));
  choose(problem_.method.thermalContact, [&](auto touching) {
    tasks.perMaterial("mpm::integrateTemperatureRate", integrateTemperatureRate<D, touching.value>, problem_.materials,
                      requiresNew(g::mass), requiresNew(g::temperatureNoBC), requiresNew(g::temperature),
                      requiresNew(g::heatRate), onlyIf(touching, requiresNew(g::contactTemperatureRate)),
                      requiresOld(delT), computes(g::temperatureRate));
  });
  tasks.perMaterial("mpm::updateTemperature", updateTemperature<Shape>, problem_.materials, requiresOld(p::x<D>),
                    requiresSize<Shape>(0), requiresDeformation<Shape>(0), requiresOld(p::temperature),
                    requiresNew(g::temperatureRate, Shape::ghostNodes), requiresOld(delT), computes(p::temperature));
}

template <class Shape>
void SolidMpm<Shape>::scheduleUpdateParticles(TaskList& tasks) const {
  tasks.perMaterial("mpm::interpolateToParticlesAndUpdate", interpolateToParticlesAndUpdate<Shape>, problem_.materials,
                    with(problem_.method), requiresOld(p::x<D>), requiresSize<Shape>(0), requiresDeformation<Shape>(0),
                    requiresOld(p::velocity<D>), requiresNew(g::acceleration<D>, Shape::ghostNodes),
                    requiresNew(g::velocityStar<D>, Shape::ghostNodes), requiresOld(delT), computes(p::x<D>),
                    computes(p::velocity<D>));
  tasks.perMaterial("mpm::addDisplacement", addDisplacement<D>, problem_.materials, requiresOld(p::x<D>), requiresNew(p::x<D>),
                    requiresOld(p::displacement<D>), computes(p::displacement<D>));
}

template <class Shape>
void SolidMpm<Shape>::scheduleComputeStressTensor(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeParticleGradients", computeParticleGradients<Shape>, problem_.materials, with(problem_.method),
                    requiresOld(p::x<D>), requiresSize<Shape>(0), requiresOld(p::deformationMeasure),
                    requiresOld(p::volume), requiresNew(g::velocityStar<D>, Shape::ghostNodes), requiresOld(delT),
                    computes(p::velocityGradient), computes(p::deformationMeasure), computes(p::volume));
  choose(isThermal(), [&](auto thermal) {
    choose(isViscous(), [&](auto viscous) {
      choose(problem_.method.strainEnergy, [&](auto energetic) {
        tasks.perMaterial("mpm::computeStressTensor",
                          computeStressTensor<D, thermal.value, viscous.value, energetic.value>, problem_.materials,
                          with(problem_.method), requiresOld(p::mass), requiresNew(p::volume),
                          requiresOld(p::velocity<D>), requiresOld(p::deformationMeasure),
                          requiresNew(p::deformationMeasure), requiresNew(p::velocityGradient), requiresOld(p::stress),
                          requiresOld(delT), onlyIf(thermal, requiresOld(p::temperature)), computes(p::stress),
                          onlyIf(viscous, computes(p::viscosity)), onlyIf(energetic, computes(p::strainEnergy)),
                          computes(c::stableTimeStep));
      });
    });
  });
}

template <class Shape>
void SolidMpm<Shape>::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perMaterial("mpm::sumMass", sumParticles, problem_.materials, requiresOld(p::mass), computes(total::mass));
  tasks.perMaterial("mpm::sumStrainEnergy", sumParticles, problem_.materials, requiresOld(p::strainEnergy),
                    computes(total::strainEnergy));
  tasks.perMaterial("mpm::sumKineticEnergy", sumKineticEnergy<D>, problem_.materials, requiresOld(p::mass),
                    requiresOld(p::velocity<D>), computes(total::kineticEnergy));
  tasks.perMaterial("mpm::sumMomentum", sumMomentum<D>, problem_.materials, requiresOld(p::mass), requiresOld(p::velocity<D>),
                    computes(total::momentum));
  tasks.perMaterial("mpm::interpolateStressToGrid", interpolateStressToGrid<Shape>, problem_.materials,
                    requiresOld(p::x<D>, Shape::reach), requiresSize<Shape>(Shape::reach),
                    requiresDeformation<Shape>(Shape::reach), requiresOld(p::volume, Shape::reach),
                    requiresOld(p::stress, Shape::reach), computes(g::volume), computes(g::stress));
  tasks.perMaterial("mpm::sumCenterOfMass", sumCenterOfMass<D>, problem_.materials, requiresOld(p::mass), requiresOld(p::x<D>),
                    computes(total::centerOfMass));
}

}  // namespace tushar::mpm::solid
