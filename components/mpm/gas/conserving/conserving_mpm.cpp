#include "components/mpm/gas/conserving/conserving_mpm.hpp"

#include "components/mpm/gas/conserving/cells.hpp"
#include "components/mpm/gas/conserving/create_boxes.hpp"
#include "components/mpm/gas/conserving/diagnose.hpp"
#include "components/mpm/gas/conserving/heat_conduction.hpp"
#include "components/mpm/gas/conserving/mixture.hpp"
#include "components/mpm/gas/conserving/redistribute.hpp"
#include "components/mpm/gas/conserving/stable_time_step.hpp"
#include "components/mpm/gas/conserving/transfer.hpp"
#include "components/mpm/gas/tasks/diagnose.hpp"
#include "components/mpm/gas/tasks/measure_error.hpp"
#include "components/mpm/gas/tasks/relax_energy.hpp"

namespace tushar::mpm::gas::conserving {

using conserving::AffineFlip;
using conserving::Apic;

template <int D>
void ConservingMpm<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.newParticles("mpm::createParticles", conserving::createBoxes<D>, materials_, creates(p::x<D>),
                     creates(p::edges<D>), creates(p::mass), creates(p::velocity<D>), creates(p::modes<D>),
                     creates(p::internalEnergy), creates(p::affineEnergy));
  if (method_.remap) tasks.perPatch("mpm::countSteps", conserving::keepCount, with(0.0), computes(remapAge));
  scheduleGridState(tasks, true);
}

template <int D>
void ConservingMpm<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  if (method_.transfer == Transfer::apic)
    tasks.perMaterial("mpm::computeStableTimeStep", conserving::computeAcousticTimeStep<D>, materials_, with(method_),
                      requiresOld(c::mass), requiresOld(c::velocityGradient<D>), requiresOld(signalPastGrid),
                      requiresOld(signalPastGas), computes(delT));
  else
    tasks.perMaterial("mpm::computeStableTimeStep", conserving::computeStableTimeStep<D>, materials_, with(method_),
                      requiresOld(p::velocity<D>), requiresOld(p::internalEnergy), requiresOld(c::mass),
                      requiresOld(c::velocityGradient<D>), computes(delT));
  if (method_.remap)
    tasks.perPatch("mpm::countSteps", conserving::countSteps, with(*method_.remap), requiresOld(remapAge),
                   requiresOld(cellFill), computes(remapCount));
}

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
  constexpr int overhang = Footprint<D>::overhang;
  tasks.perMaterial("mpm::computeStress", conserving::computeStress<D, Scheme>, materials_, requiresOld(c::pressure),
                    requiresOld(c::viscosity), requiresOld(c::velocityGradient<D>), requiresOld(delT),
                    computes(c::stress<D>));
  tasks.perMaterial("mpm::computeInternalForce", conserving::computeAcceleration<D>, materials_,
                    requiresNew(c::stress<D>, 1), requiresOld(g::mass), computes(g::acceleration<D>));
  tasks.perMaterial("mpm::computeRelaxation", conserving::computeRelaxation<D>, materials_, requiresOld(c::shock, 1),
                    computes(g::relaxation));
  if (isMixture())
    tasks.acrossMaterials("mpm::computeWork", conserving::computeMixtureWork<D>, materials_, requiresNew(c::stress<D>),
                          requiresOld(c::mass), requiresOld(c::internalEnergy), requiresOld(c::fill),
                          requiresOld(g::velocity<D>), requiresNew(g::acceleration<D>), requiresOld(delT),
                          computes(c::work));
  else
    tasks.perMaterial("mpm::computeWork", conserving::computeWork<D>, materials_, requiresNew(c::stress<D>),
                      requiresOld(c::internalEnergy), requiresOld(g::velocity<D>), requiresNew(g::acceleration<D>),
                      requiresOld(delT), computes(c::work));
  if (method_.heatConduction > 0)
    tasks.perMaterial("mpm::conductHeat", conserving::conductHeat<D>, materials_, with(method_.heatConduction),
                      requiresOld(c::mass, 1), requiresOld(c::internalEnergy, 1),
                      requiresOld(c::velocityGradient<D>, 1), requiresOld(delT), modifies(c::work));
  tasks.perMaterial("mpm::updateParticles", conserving::updateParticles<D, Scheme>, materials_, requiresOld(p::x<D>),
                    requiresOld(p::edges<D>), requiresOld(p::velocity<D>), requiresOld(p::modes<D>),
                    requiresOld(p::internalEnergy), requiresOld(p::affineEnergy), requiresOld(g::velocity<D>, overhang),
                    requiresNew(g::acceleration<D>, overhang), requiresNew(g::relaxation, overhang),
                    requiresNew(c::work, overhang), requiresOld(delT), computes(p::x<D>), computes(p::edges<D>),
                    computes(p::velocity<D>), computes(p::modes<D>), computes(p::internalEnergy),
                    computes(p::affineEnergy), computes(recomputeTimeStep));
}

template <int D>
void ConservingMpm<D>::scheduleRedistribute(TaskList& tasks) const {
  constexpr int overhang = Footprint<D>::overhang;
  const auto schedule = [&](auto body, auto... more) {
    tasks.newParticles("mpm::redistribute", body, materials_, with(method_.longestParticle),
                       requiresNew(data::particleId, overhang), requiresNew(p::x<D>, overhang),
                       requiresNew(p::edges<D>, overhang), requiresNew(p::mass, overhang),
                       requiresNew(p::velocity<D>, overhang), requiresNew(p::modes<D>, overhang),
                       requiresNew(p::internalEnergy, overhang), requiresNew(p::affineEnergy, overhang), more...,
                       creates(p::x<D>), creates(p::edges<D>), creates(p::mass), creates(p::velocity<D>),
                       creates(p::modes<D>), creates(p::internalEnergy), creates(p::affineEnergy));
  };
  if (!method_.remap) return schedule(conserving::redistribute<D>);
  tasks.perMaterial("mpm::gatherInCells", conserving::gatherInCells<D>, materials_, requiresNew(p::x<D>, overhang),
                    requiresNew(p::edges<D>, overhang), requiresNew(p::mass, overhang),
                    requiresNew(p::internalEnergy, overhang), requiresOld(remapCount), computes(c::movedMass),
                    computes(c::movedEnergy));
  schedule(conserving::redistributeOrRemap<D>, requiresNew(c::movedMass, overhang + 1),
           requiresNew(c::movedEnergy, overhang + 1), requiresOld(remapCount));
  tasks.perPatch("mpm::countSteps", conserving::keepCount, requiresOld(remapCount), computes(remapAge));
}

template <int D>
void ConservingMpm<D>::scheduleGridState(TaskList& tasks, bool isStart) const {
  constexpr int reach = Footprint<D>::reach;
  const double spare = method_.transfer == Transfer::apic ? Apic::spareEnergy : AffineFlip::spareEnergy;
  if (isMixture())
    tasks.perMaterial("mpm::computeHeat", conserving::computeHeat<D>, materials_, requiresNew(p::mass),
                      requiresNew(p::edges<D>), requiresNew(p::internalEnergy), computes(p::heat));
  tasks.perMaterial("mpm::limitModes", conserving::limitModes<D>, materials_, with(spare), requiresNew(p::edges<D>),
                    requiresNew(isMixture() ? p::heat : p::internalEnergy), requiresNew(p::affineEnergy),
                    modifies(p::modes<D>));
  const auto schedule = [&](auto body, auto... more) {
    tasks.perMaterial("mpm::interpolateParticlesToGrid", body, materials_, requiresNew(p::x<D>, reach),
                      requiresNew(p::edges<D>, reach), requiresNew(p::mass, reach), requiresNew(p::velocity<D>, reach),
                      requiresNew(p::modes<D>, reach), requiresNew(p::internalEnergy, reach), computes(g::mass),
                      computes(g::velocity<D>), computes(c::mass), computes(c::internalEnergy), more...);
  };
  if (method_.remap || isMixture())
    schedule(conserving::interpolateAndMeasureFill<D>, computes(c::fill), computes(cellFill));
  else
    schedule(conserving::interpolateParticlesToGrid<D>);
  if (isMixture() && isStart)
    tasks.acrossMaterials("mpm::checkFill", conserving::checkFill<D>, materials_, modifies(c::fill));
  if (isMixture())
    tasks.acrossMaterials("mpm::mixAtNodes", conserving::mixAtNodes<D>, materials_, modifies(g::mass),
                          modifies(g::velocity<D>));
  tasks.perMaterial("mpm::computeVelocityGradient", conserving::computeVelocityGradient<D>, materials_,
                    requiresNew(g::velocity<D>), computes(c::velocityGradient<D>));
  if (isMixture()) return scheduleMixtureState(tasks);
  if (method_.transfer != Transfer::apic) return scheduleComputePressure<AffineFlip>(tasks);
  scheduleComputePressure<Apic>(tasks);
  tasks.perMaterial("mpm::measureSignals", conserving::measureSignals<D>, materials_, requiresNew(p::velocity<D>),
                    requiresNew(p::internalEnergy), requiresNew(c::mass), requiresNew(c::internalEnergy),
                    requiresNew(c::velocityGradient<D>), computes(signalPastGrid), computes(signalPastGas));
}

template <int D>
void ConservingMpm<D>::scheduleMixtureState(TaskList& tasks) const {
  tasks.acrossMaterials("mpm::computePressure", conserving::computeMixturePressure<D>, materials_,
                        with(method_.viscosity), requiresNew(c::mass), requiresNew(c::internalEnergy),
                        requiresNew(c::fill), requiresNew(c::velocityGradient<D>), computes(c::pressure),
                        computes(c::viscosity), computes(c::shock));
  tasks.acrossMaterials("mpm::measureSignals", conserving::measureMixtureSignals<D>, materials_, requiresNew(c::mass),
                        requiresNew(c::internalEnergy), requiresNew(c::fill), requiresNew(c::velocityGradient<D>),
                        requiresNew(g::velocity<D>), computes(signalPastGrid), computes(signalPastGas));
}

template <int D>
template <class Scheme>
void ConservingMpm<D>::scheduleComputePressure(TaskList& tasks) const {
  tasks.perMaterial("mpm::computePressure", conserving::computePressure<D, Scheme>, materials_, with(method_.viscosity),
                    requiresNew(c::mass), requiresNew(c::internalEnergy), requiresNew(c::velocityGradient<D>, 1),
                    computes(c::pressure), computes(c::viscosity), computes(c::shock));
}

template <int D>
void ConservingMpm<D>::scheduleDiagnostics(TaskList& tasks) const {
  constexpr int overhang = Footprint<D>::overhang;
  tasks.perMaterial("mpm::sumMass", sumMass<D>, materials_, requiresOld(p::mass), computes(total::mass));
  tasks.perMaterial("mpm::sumMomentum", sumMomentum<D>, materials_, requiresOld(p::mass), requiresOld(p::velocity<D>),
                    computes(total::momentum));
  tasks.perMaterial("mpm::sumEnergy", conserving::sumEnergy<D>, materials_, requiresOld(p::mass),
                    requiresOld(p::velocity<D>), requiresOld(p::internalEnergy), requiresOld(p::affineEnergy),
                    computes(total::kineticEnergy), computes(total::internalEnergy), computes(total::energy));
  tasks.perMaterial("mpm::sumCenterOfMass", sumCenterOfMass<D>, materials_, requiresOld(p::mass), requiresOld(p::x<D>),
                    computes(total::centerOfMass));
  tasks.perMaterial("mpm::computeDensity", conserving::computeDensity<D>, materials_, requiresOld(p::mass),
                    requiresOld(p::edges<D>), requiresOld(p::internalEnergy), computes(p::density),
                    computes(p::pressure), computes(p::volume));
  tasks.perMaterial("mpm::findLeast", findLeast, materials_, requiresNew(p::density), requiresOld(p::internalEnergy),
                    computes(total::leastDensity), computes(total::leastEnergy));
  tasks.perMaterial("mpm::sumEntropy", sumEntropy<D>, materials_, requiresOld(p::mass), requiresNew(p::density),
                    requiresOld(p::internalEnergy), computes(total::entropy));
  tasks.perMaterial("mpm::computeCellDensity", conserving::computeCellDensity<D>, materials_, requiresOld(c::mass),
                    computes(c::density));
  tasks.perMaterial("mpm::computeCellVelocity", conserving::computeCellVelocity<D>, materials_,
                    requiresOld(p::x<D>, overhang), requiresOld(p::edges<D>, overhang), requiresOld(p::mass, overhang),
                    requiresOld(p::velocity<D>, overhang), requiresOld(p::modes<D>, overhang), requiresOld(c::mass),
                    computes(c::velocity<D>));
}

template <int D>
void ConservingMpm<D>::scheduleMeasureError(TaskList& tasks, const reference::GasReference& exact,
                                            const reference::Clock& clock) const {
  tasks.perMaterial("mpm::measureParticleError", measureParticleError<D>, materials_, with(&exact), with(&clock),
                    requiresOld(p::x<D>), requiresNew(p::density), requiresOld(p::velocity<D>),
                    requiresOld(p::internalEnergy), computes(reference::particleError.density),
                    computes(reference::particleError.velocity), computes(reference::particleError.pressure),
                    computes(reference::particleError.energy));
  if (isMixture())
    tasks.acrossMaterials("mpm::measureCellError", conserving::measureMixtureError<D>, materials_, with(&exact),
                          with(&clock), requiresOld(c::mass), requiresNew(c::velocity<D>),
                          requiresOld(c::internalEnergy), requiresOld(c::fill), computes(reference::cellError.density),
                          computes(reference::cellError.velocity), computes(reference::cellError.pressure),
                          computes(reference::cellError.energy));
  else
    tasks.perMaterial("mpm::measureCellError", conserving::measureCellError<D>, materials_, with(&exact), with(&clock),
                      requiresOld(c::mass), requiresNew(c::velocity<D>), requiresOld(c::internalEnergy),
                      computes(reference::cellError.density), computes(reference::cellError.velocity),
                      computes(reference::cellError.pressure), computes(reference::cellError.energy));
  tasks.perMaterial("mpm::measureNodeError", measureNodeError<D>, materials_, with(&exact), with(&clock),
                    requiresOld(g::mass), computes(reference::nodeError));
}

template class ConservingMpm<1>;
template class ConservingMpm<2>;
template class ConservingMpm<3>;

}  // namespace tushar::mpm::gas::conserving
