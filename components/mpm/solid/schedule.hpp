#pragma once

#include "components/mpm/solid/solid_mpm.hpp"

#include "components/mpm/solid/tasks/compute_internal_force.hpp"
#include "components/mpm/solid/tasks/compute_particle_gradients.hpp"
#include "components/mpm/solid/tasks/compute_stress.hpp"
#include "components/mpm/solid/tasks/create_particles.hpp"
#include "components/mpm/solid/tasks/diagnose.hpp"
#include "components/mpm/solid/tasks/exchange_momentum.hpp"
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

template <class Shape>
void SolidMpm<Shape>::scheduleInitialize(TaskList& tasks) const {
  tasks.newParticles("mpm::actuallyInitialize", actuallyInitialize<D>, materials_, creates(p::x<D>),
                     creates(p::velocity<D>), creates(p::displacement<D>), creates(p::size<D>), creates(p::mass),
                     creates(p::volume), creates(p::temperature), creates(p::color), creates(p::deformationMeasure),
                     creates(p::stress), creates(p::viscosity), creates(p::strainEnergy));
  tasks.perMaterial("mpm::computeInitialTimeStep", computeInitialTimeStep<D>, materials_, requiresNew(p::velocity<D>),
                    requiresNew(p::temperature), computes(c::stableTimeStep));
}

template <class Shape>
void SolidMpm<Shape>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeStableTimeStep", computeStableTimeStep<D>, materials_, requiresOld(c::stableTimeStep),
                    computes(delT));
}

template <class Shape>
void SolidMpm<Shape>::scheduleTimeAdvance(TaskList& tasks) const {
  scheduleInterpolateParticlesToGrid(tasks);
  scheduleComputeInternalForce(tasks);
  scheduleIntegrateAcceleration(tasks);
  scheduleUpdateParticles(tasks);
  scheduleComputeStressTensor(tasks);
  tasks.relocate(p::x<D>, materials_);
}

template <class Shape>
void SolidMpm<Shape>::scheduleInterpolateParticlesToGrid(TaskList& tasks) const {
  tasks.perMaterial("mpm::interpolateParticlesToGrid", interpolateParticlesToGrid<Shape>, materials_,
                    requiresOld(p::x<D>, Shape::reach), requiresSize<Shape>(Shape::reach),
                    requiresDeformation<Shape>(Shape::reach), requiresOld(p::mass, Shape::reach),
                    requiresOld(p::velocity<D>, Shape::reach), computes(g::mass), computes(g::velocity<D>));
  if (!contacts_.empty())
    tasks.acrossMaterials("mpm::exMomInterpolated", exMomInterpolated<D>, materials_, with(contacts_),
                          requiresNew(g::mass), modifies(g::velocity<D>));
}

template <class Shape>
void SolidMpm<Shape>::scheduleComputeInternalForce(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeInternalForce", computeInternalForce<Shape>, materials_,
                    requiresOld(p::x<D>, Shape::reach), requiresSize<Shape>(Shape::reach),
                    requiresDeformation<Shape>(Shape::reach), requiresOld(p::volume, Shape::reach),
                    requiresOld(p::stress, Shape::reach), requiresOld(p::viscosity, Shape::reach),
                    computes(g::internalForce<D>));
}

template <class Shape>
void SolidMpm<Shape>::scheduleIntegrateAcceleration(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeAndIntegrateAcceleration", computeAndIntegrateAcceleration<D>, materials_,
                    with(method_), requiresNew(g::mass), requiresNew(g::internalForce<D>), requiresNew(g::velocity<D>),
                    requiresOld(delT), computes(g::velocityStar<D>));
  if (!contacts_.empty())
    tasks.acrossMaterials("mpm::exMomIntegrated", exMomIntegrated<D>, materials_, with(contacts_), startTime(),
                          requiresNew(g::mass), modifies(g::velocityStar<D>));
  tasks.perMaterial("mpm::setGridBoundaryConditions", setGridBoundaryConditions<D>, materials_,
                    requiresNew(g::velocity<D>), requiresOld(delT), modifies(g::velocityStar<D>),
                    computes(g::acceleration<D>));
}

template <class Shape>
void SolidMpm<Shape>::scheduleUpdateParticles(TaskList& tasks) const {
  tasks.perMaterial("mpm::interpolateToParticlesAndUpdate", interpolateToParticlesAndUpdate<Shape>, materials_,
                    with(method_), requiresOld(p::x<D>), requiresSize<Shape>(0), requiresDeformation<Shape>(0),
                    requiresOld(p::velocity<D>), requiresNew(g::acceleration<D>, Shape::ghostNodes),
                    requiresNew(g::velocityStar<D>, Shape::ghostNodes), requiresOld(delT), computes(p::x<D>),
                    computes(p::velocity<D>));
  tasks.perMaterial("mpm::addDisplacement", addDisplacement<D>, materials_, requiresOld(p::x<D>), requiresNew(p::x<D>),
                    requiresOld(p::displacement<D>), computes(p::displacement<D>));
}

template <class Shape>
void SolidMpm<Shape>::scheduleComputeStressTensor(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeParticleGradients", computeParticleGradients<Shape>, materials_, with(method_),
                    requiresOld(p::x<D>), requiresSize<Shape>(0), requiresOld(p::deformationMeasure),
                    requiresOld(p::volume), requiresNew(g::velocityStar<D>, Shape::ghostNodes), requiresOld(delT),
                    computes(p::velocityGradient), computes(p::deformationMeasure), computes(p::volume));
  tasks.perMaterial("mpm::computeStressTensor", computeStressTensor<D>, materials_, with(method_), requiresOld(p::mass),
                    requiresNew(p::volume), requiresOld(p::temperature), requiresOld(p::velocity<D>),
                    requiresOld(p::deformationMeasure), requiresNew(p::deformationMeasure),
                    requiresNew(p::velocityGradient), requiresOld(p::stress), requiresOld(delT), computes(p::stress),
                    computes(p::viscosity), computes(p::strainEnergy), computes(c::stableTimeStep));
}

template <class Shape>
void SolidMpm<Shape>::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perMaterial("mpm::sumMass", sumParticles, materials_, requiresOld(p::mass), computes(total::mass));
  tasks.perMaterial("mpm::sumStrainEnergy", sumParticles, materials_, requiresOld(p::strainEnergy),
                    computes(total::strainEnergy));
  tasks.perMaterial("mpm::sumKineticEnergy", sumKineticEnergy<D>, materials_, requiresOld(p::mass),
                    requiresOld(p::velocity<D>), computes(total::kineticEnergy));
  tasks.perMaterial("mpm::sumMomentum", sumMomentum<D>, materials_, requiresOld(p::mass), requiresOld(p::velocity<D>),
                    computes(total::momentum));
  tasks.perMaterial("mpm::interpolateStressToGrid", interpolateStressToGrid<Shape>, materials_,
                    requiresOld(p::x<D>, Shape::reach), requiresSize<Shape>(Shape::reach),
                    requiresDeformation<Shape>(Shape::reach), requiresOld(p::volume, Shape::reach),
                    requiresOld(p::stress, Shape::reach), computes(g::volume), computes(g::stress));
  tasks.perMaterial("mpm::sumCenterOfMass", sumCenterOfMass<D>, materials_, requiresOld(p::mass), requiresOld(p::x<D>),
                    computes(total::centerOfMass));
}

}  // namespace tushar::mpm::solid
