#include "components/mpm/gas/conserving/conserving_mpm.hpp"

#include "components/mpm/gas/conserving/cells.hpp"
#include "components/mpm/gas/conserving/create_boxes.hpp"
#include "components/mpm/gas/conserving/diagnose.hpp"
#include "components/mpm/gas/conserving/heat_conduction.hpp"
#include "components/mpm/gas/conserving/mixture.hpp"
#include "components/mpm/gas/conserving/redistribute.hpp"
#include "components/mpm/gas/conserving/stable_time_step.hpp"
#include "components/mpm/gas/conserving/transfer.hpp"
#include "components/mpm/gas/conserving/update_particles.hpp"
#include "components/mpm/gas/tasks/diagnose.hpp"
#include "components/mpm/gas/tasks/measure_error.hpp"
#include "components/mpm/gas/tasks/relax_energy.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

/// The ways in which a group reads its labels: the values at the start of the step, or those computed by an earlier
/// task of the list.
constexpr auto atStart = [](const auto& label) { return requiresOld(label); };
constexpr auto asComputed = [](const auto& label) { return requiresNew(label); };

}  // namespace

template <int D>
void ConservingMpm<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.newParticles("mpm::createParticles", createBoxes<D>, materials_, all<NewBoxes<D>>());
  if (method_.remap) tasks.perPatch("mpm::countSteps", keepCount, with(0.0), computes(remapAge));
  scheduleGridState(tasks, true);
}

template <int D>
void ConservingMpm<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  if (method_.transfer == Transfer::apic)
    tasks.perMaterial("mpm::computeStableTimeStep", computeAcousticTimeStep<D>, materials_, with(method_),
                      requiresOld(c::mass), requiresOld(c::velocityGradient<D>), requiresOld(signalPastGrid),
                      requiresOld(signalPastGas), computes(delT));
  else
    tasks.perMaterial("mpm::computeStableTimeStep", computeStableTimeStep<D>, materials_, with(method_),
                      requiresOld(p::velocity<D>), requiresOld(p::internalEnergy), requiresOld(c::mass),
                      requiresOld(c::velocityGradient<D>), computes(delT));
  if (method_.remap)
    tasks.perPatch("mpm::countSteps", countSteps, with(*method_.remap), requiresOld(remapAge), requiresOld(cellFill),
                   computes(remapCount));
}

/// One step: forces and work on the grid, (E1)-(E3) for the particles, and the new state of the grid.
template <int D>
void ConservingMpm<D>::scheduleTimeAdvance(TaskList& tasks) const {
  if (method_.transfer == Transfer::apic)
    scheduleStep<Apic>(tasks);
  else
    scheduleStep<AffineFlip>(tasks);
  scheduleRelaxEnergy(tasks, materials_);
  tasks.relocate(p::x<D>, materials_);
  scheduleRedistribute(tasks);
  scheduleGridState(tasks);
}

template <int D>
template <class Scheme>
void ConservingMpm<D>::scheduleStep(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeStress", computeStress<D, Scheme>, materials_, requiresOld(c::pressure),
                    requiresOld(c::viscosity), requiresOld(c::velocityGradient<D>), requiresOld(delT),
                    computes(c::stress<D>));
  tasks.perMaterial("mpm::computeInternalForce", computeAcceleration<D>, materials_, requiresNew(c::stress<D>, 1),
                    requiresOld(g::mass), computes(g::acceleration<D>));
  tasks.perMaterial("mpm::computeRelaxation", computeRelaxation<D>, materials_, requiresOld(c::shock, 1),
                    computes(g::relaxation));
  if (isMixture())
    tasks.acrossMaterials("mpm::computeWork", computeMixtureWork<D>, materials_, requiresNew(c::stress<D>),
                          all<GasInCells>(atStart), requiresOld(g::velocity<D>), requiresNew(g::acceleration<D>),
                          requiresOld(delT), computes(c::work));
  else
    tasks.perMaterial("mpm::computeWork", computeWork<D>, materials_, requiresNew(c::stress<D>),
                      requiresOld(c::internalEnergy), requiresOld(g::velocity<D>), requiresNew(g::acceleration<D>),
                      requiresOld(delT), computes(c::work));
  if (method_.heatConduction > 0)
    tasks.perMaterial("mpm::conductHeat", conductHeat<D>, materials_, with(method_.heatConduction),
                      requiresOld(c::mass, 1), requiresOld(c::internalEnergy, 1),
                      requiresOld(c::velocityGradient<D>, 1), requiresOld(delT), modifies(c::work));
  tasks.perMaterial("mpm::updateParticles", updateParticles<D, Scheme>, materials_, all<ParticleUpdate<D>>(),
                    requiresOld(delT), computes(recomputeTimeStep));
}

template <int D>
void ConservingMpm<D>::scheduleRedistribute(TaskList& tasks) const {
  constexpr int overhang = Footprint<D>::overhang;
  if (!method_.remap) {
    tasks.newParticles("mpm::redistribute", redistribute<D>, materials_, with(method_.longestParticle),
                       all<OldBoxes<D>>(overhang), all<NewBoxes<D>>());
    return;
  }
  tasks.perMaterial("mpm::gatherInCells", gatherInCells<D>, materials_, requiresNew(p::x<D>, overhang),
                    requiresNew(p::edges<D>, overhang), requiresNew(p::mass, overhang),
                    requiresNew(p::internalEnergy, overhang), requiresOld(remapCount), computes(c::movedMass),
                    computes(c::movedEnergy));
  tasks.newParticles("mpm::redistribute", redistributeOrRemap<D>, materials_, with(method_.longestParticle),
                     all<OldBoxes<D>>(overhang), requiresNew(c::movedMass, overhang + 1),
                     requiresNew(c::movedEnergy, overhang + 1), requiresOld(remapCount), all<NewBoxes<D>>());
  tasks.perPatch("mpm::countSteps", keepCount, requiresOld(remapCount), computes(remapAge));
}

template <int D>
void ConservingMpm<D>::scheduleGridState(TaskList& tasks, bool isStart) const {
  const double spare = method_.transfer == Transfer::apic ? Apic::spareEnergy : AffineFlip::spareEnergy;
  if (isMixture())
    tasks.perMaterial("mpm::computeHeat", computeHeat<D>, materials_, requiresNew(p::mass), requiresNew(p::edges<D>),
                      requiresNew(p::internalEnergy), computes(p::heat));
  tasks.perMaterial("mpm::limitModes", limitModes<D>, materials_, with(spare), requiresNew(p::edges<D>),
                    requiresNew(isMixture() ? p::heat : p::internalEnergy), requiresNew(p::affineEnergy),
                    modifies(p::modes<D>));
  if (method_.remap || isMixture())
    tasks.perMaterial("mpm::interpolateParticlesToGrid", interpolateAndMeasureFill<D>, materials_,
                      all<ParticlesToGrid<D>>(), computes(c::fill), computes(cellFill));
  else
    tasks.perMaterial("mpm::interpolateParticlesToGrid", interpolateParticlesToGrid<D>, materials_,
                      all<ParticlesToGrid<D>>());
  if (isMixture() && isStart) tasks.acrossMaterials("mpm::checkFill", checkFill<D>, materials_, modifies(c::fill));
  if (isMixture())
    tasks.acrossMaterials("mpm::mixAtNodes", mixAtNodes<D>, materials_, modifies(g::mass), modifies(g::velocity<D>));
  tasks.perMaterial("mpm::computeVelocityGradient", computeVelocityGradient<D>, materials_, requiresNew(g::velocity<D>),
                    computes(c::velocityGradient<D>));
  if (isMixture()) return scheduleMixtureState(tasks);
  if (method_.transfer != Transfer::apic) return scheduleComputePressure<AffineFlip>(tasks);
  scheduleComputePressure<Apic>(tasks);
  tasks.perMaterial("mpm::measureSignals", measureSignals<D>, materials_, requiresNew(p::velocity<D>),
                    requiresNew(p::internalEnergy), requiresNew(c::mass), requiresNew(c::internalEnergy),
                    requiresNew(c::velocityGradient<D>), computes(signalPastGrid), computes(signalPastGas));
}

template <int D>
void ConservingMpm<D>::scheduleMixtureState(TaskList& tasks) const {
  tasks.acrossMaterials("mpm::computePressure", computeMixturePressure<D>, materials_, with(method_.viscosity),
                        all<GasInCells>(asComputed), requiresNew(c::velocityGradient<D>), computes(c::pressure),
                        computes(c::viscosity), computes(c::shock));
  tasks.acrossMaterials("mpm::measureSignals", measureMixtureSignals<D>, materials_, all<GasInCells>(asComputed),
                        requiresNew(c::velocityGradient<D>), requiresNew(g::velocity<D>), computes(signalPastGrid),
                        computes(signalPastGas));
}

template <int D>
template <class Scheme>
void ConservingMpm<D>::scheduleComputePressure(TaskList& tasks) const {
  tasks.perMaterial("mpm::computePressure", computePressure<D, Scheme>, materials_, with(method_.viscosity),
                    requiresNew(c::mass), requiresNew(c::internalEnergy), requiresNew(c::velocityGradient<D>, 1),
                    computes(c::pressure), computes(c::viscosity), computes(c::shock));
}

template <int D>
void ConservingMpm<D>::scheduleDiagnostics(TaskList& tasks) const {
  constexpr int overhang = Footprint<D>::overhang;
  tasks.perMaterial("mpm::sumMass", sumMass<D>, materials_, requiresOld(p::mass), computes(total::mass));
  tasks.perMaterial("mpm::sumMomentum", sumMomentum<D>, materials_, requiresOld(p::mass), requiresOld(p::velocity<D>),
                    computes(total::momentum));
  tasks.perMaterial("mpm::sumEnergy", sumEnergy<D>, materials_, requiresOld(p::mass), requiresOld(p::velocity<D>),
                    requiresOld(p::internalEnergy), requiresOld(p::affineEnergy), computes(total::kineticEnergy),
                    computes(total::internalEnergy), computes(total::energy));
  tasks.perMaterial("mpm::sumCenterOfMass", sumCenterOfMass<D>, materials_, requiresOld(p::mass), requiresOld(p::x<D>),
                    computes(total::centerOfMass));
  tasks.perMaterial("mpm::computeDensity", computeDensity<D>, materials_, requiresOld(p::mass),
                    requiresOld(p::edges<D>), requiresOld(p::internalEnergy), computes(p::density),
                    computes(p::pressure), computes(p::volume));
  tasks.perMaterial("mpm::findLeast", findLeast, materials_, requiresNew(p::density), requiresOld(p::internalEnergy),
                    computes(total::leastDensity), computes(total::leastEnergy));
  tasks.perMaterial("mpm::sumEntropy", sumEntropy<D>, materials_, requiresOld(p::mass), requiresNew(p::density),
                    requiresOld(p::internalEnergy), computes(total::entropy));
  tasks.perMaterial("mpm::computeCellDensity", computeCellDensity<D>, materials_, requiresOld(c::mass),
                    computes(c::density));
  tasks.perMaterial("mpm::computeCellVelocity", computeCellVelocity<D>, materials_, requiresOld(p::x<D>, overhang),
                    requiresOld(p::edges<D>, overhang), requiresOld(p::mass, overhang),
                    requiresOld(p::velocity<D>, overhang), requiresOld(p::modes<D>, overhang), requiresOld(c::mass),
                    computes(c::velocity<D>));
}

template <int D>
void ConservingMpm<D>::scheduleMeasureError(TaskList& tasks, const reference::GasReference& exact,
                                            const reference::Clock& clock) const {
  tasks.perMaterial("mpm::measureParticleError", measureParticleError<D>, materials_, with(&exact), with(&clock),
                    requiresOld(p::x<D>), requiresNew(p::density), requiresOld(p::velocity<D>),
                    requiresOld(p::internalEnergy), all<ErrorNorms>(&reference::particleError));
  if (isMixture())
    tasks.acrossMaterials("mpm::measureCellError", measureMixtureError<D>, materials_, with(&exact), with(&clock),
                          all<GasInCells>(atStart), requiresNew(c::velocity<D>), computes(reference::cellError.density),
                          computes(reference::cellError.velocity), computes(reference::cellError.pressure),
                          computes(reference::cellError.energy));
  else
    tasks.perMaterial("mpm::measureCellError", measureCellError<D>, materials_, with(&exact), with(&clock),
                      requiresOld(c::mass), requiresNew(c::velocity<D>), requiresOld(c::internalEnergy),
                      all<ErrorNorms>(&reference::cellError));
  tasks.perMaterial("mpm::measureNodeError", measureNodeError<D>, materials_, with(&exact), with(&clock),
                    requiresOld(g::mass), computes(reference::nodeError));
}

template class ConservingMpm<1>;
template class ConservingMpm<2>;
template class ConservingMpm<3>;

}  // namespace tushar::mpm::gas::conserving
