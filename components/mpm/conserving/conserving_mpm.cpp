#include "components/mpm/conserving/conserving_mpm.hpp"

#include "components/mpm/conserving/diagnose.hpp"
#include "components/mpm/conserving/tasks.hpp"
#include "components/mpm/tasks/diagnose.hpp"
#include "components/mpm/tasks/measure_error.hpp"

namespace tushar::mpm {

void ConservingMpm::scheduleInitialize(TaskList& tasks) const {
  tasks.newParticles("mpm::createParticles", conserving::createParticles, materials_, creates(p::x<1>),
                     creates(p::length), creates(p::mass), creates(p::velocity<1>), creates(p::velocityGradient),
                     creates(p::internalEnergy), creates(p::affineEnergy));
  scheduleGridState(tasks);
}

void ConservingMpm::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeStableTimeStep", conserving::computeStableTimeStep, materials_, with(method_.cfl),
                    requiresOld(p::velocity<1>), requiresOld(p::internalEnergy), requiresOld(g::velocity<1>),
                    requiresOld(g::acceleration<1>), computes(delT));
}

void ConservingMpm::scheduleTimeAdvance(TaskList& tasks) const {
  constexpr int overhang = Extent::overhang;
  tasks.perMaterial("mpm::updateParticles", conserving::updateParticles, materials_, requiresOld(p::x<1>),
                    requiresOld(p::length), requiresOld(p::velocity<1>), requiresOld(p::velocityGradient),
                    requiresOld(p::internalEnergy), requiresOld(p::affineEnergy), requiresOld(g::velocity<1>, overhang),
                    requiresOld(g::acceleration<1>, overhang), requiresOld(c::stress, overhang), requiresOld(c::internalEnergy, overhang),
                    requiresOld(delT), computes(p::x<1>), computes(p::length), computes(p::velocity<1>),
                    computes(p::velocityGradient), computes(p::internalEnergy), computes(p::affineEnergy));
  tasks.relocate(p::x<1>, materials_);
  tasks.perMaterial("mpm::limitGradient", conserving::limitGradient, materials_, requiresNew(p::length),
                    requiresNew(p::internalEnergy), requiresNew(p::affineEnergy),
                    modifies(p::velocityGradient));
  scheduleRedistribute(tasks);
  scheduleGridState(tasks);
}

void ConservingMpm::scheduleRedistribute(TaskList& tasks) const {
  tasks.newParticles("mpm::redistribute", conserving::splitLong, materials_, with(method_.longestParticle),
                     requiresNew(data::particleId, 1),
                     requiresNew(p::x<1>, 1), requiresNew(p::length, 1), requiresNew(p::mass, 1),
                     requiresNew(p::velocity<1>, 1), requiresNew(p::velocityGradient, 1),
                     requiresNew(p::internalEnergy, 1), requiresNew(p::affineEnergy, 1), creates(p::x<1>),
                     creates(p::length), creates(p::mass), creates(p::velocity<1>), creates(p::velocityGradient),
                     creates(p::internalEnergy), creates(p::affineEnergy));
}

void ConservingMpm::scheduleGridState(TaskList& tasks) const {
  constexpr int reach = conserving::reach;
  tasks.perMaterial("mpm::interpolateParticlesToGrid", conserving::interpolateParticlesToGrid, materials_,
                    requiresNew(p::x<1>, reach), requiresNew(p::length, reach), requiresNew(p::mass, reach),
                    requiresNew(p::velocity<1>, reach), requiresNew(p::velocityGradient, reach),
                    requiresNew(p::internalEnergy, reach), computes(g::mass), computes(g::velocity<1>),
                    computes(c::mass), computes(c::internalEnergy));
  tasks.perMaterial("mpm::computeStress", conserving::computeStress, materials_, with(method_.viscosity),
                    requiresNew(c::mass), requiresNew(c::internalEnergy), requiresNew(g::velocity<1>),
                    computes(c::stress));
  tasks.perMaterial("mpm::computeInternalForce", conserving::computeAcceleration, materials_, requiresNew(c::stress, 1),
                    requiresNew(g::mass), computes(g::acceleration<1>));
}

void ConservingMpm::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perMaterial("mpm::sumMass", sumMass<1>, materials_, requiresOld(p::mass), computes(total::mass));
  tasks.perMaterial("mpm::sumMomentum", sumMomentum<1>, materials_, requiresOld(p::mass), requiresOld(p::velocity<1>),
                    computes(total::momentum));
  tasks.perMaterial("mpm::sumEnergy", conserving::sumEnergy, materials_, requiresOld(p::mass),
                    requiresOld(p::velocity<1>), requiresOld(p::internalEnergy), requiresOld(p::affineEnergy),
                    computes(total::kineticEnergy), computes(total::internalEnergy), computes(total::energy));
  tasks.perMaterial("mpm::sumCenterOfMass", sumCenterOfMass<1>, materials_, requiresOld(p::mass), requiresOld(p::x<1>),
                    computes(total::centerOfMass));
  tasks.perMaterial("mpm::computeDensity", conserving::computeDensity, materials_, requiresOld(p::mass),
                    requiresOld(p::length), requiresOld(p::internalEnergy), computes(p::density), computes(p::pressure),
                    computes(p::volume));
}

void ConservingMpm::scheduleMeasureError(TaskList& tasks, const reference::GasReference& exact,
                                         const reference::Clock& clock) const {
  tasks.perMaterial("mpm::measureParticleError", measureParticleError<1>, materials_, with(&exact), with(&clock),
                    requiresOld(p::x<1>), requiresNew(p::density), requiresOld(p::velocity<1>),
                    requiresOld(p::internalEnergy), computes(reference::particleError.density),
                    computes(reference::particleError.velocity), computes(reference::particleError.pressure),
                    computes(reference::particleError.energy));
  tasks.perMaterial("mpm::measureCellError", conserving::measureCellError, materials_, with(&exact), with(&clock),
                    requiresOld(p::x<1>, conserving::reach), requiresOld(p::length, conserving::reach),
                    requiresOld(p::mass, conserving::reach), requiresOld(p::velocity<1>, conserving::reach),
                    requiresOld(c::mass), requiresOld(c::internalEnergy), computes(reference::cellError.density),
                    computes(reference::cellError.velocity), computes(reference::cellError.pressure),
                    computes(reference::cellError.energy));
  tasks.perMaterial("mpm::measureNodeError", measureNodeError<1>, materials_, with(&exact), with(&clock),
                    requiresOld(g::mass), computes(reference::nodeError));
}

}  // namespace tushar::mpm
