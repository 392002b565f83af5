#include "components/mpm/gas/paper/gas_mpm.hpp"

#include "components/mpm/gas/paper/tasks/compute_internal_force.hpp"
#include "components/mpm/gas/paper/tasks/compute_pressure.hpp"
#include "components/mpm/gas/paper/tasks/filter_density.hpp"
#include "components/mpm/gas/paper/tasks/integrate_acceleration.hpp"
#include "components/mpm/gas/paper/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/gas/paper/tasks/redistribute.hpp"
#include "components/mpm/gas/paper/tasks/update_particles.hpp"
#include "components/mpm/gas/tasks/create_particles.hpp"
#include "components/mpm/gas/tasks/diagnose.hpp"
#include "components/mpm/gas/tasks/measure_error.hpp"
#include "components/mpm/gas/tasks/relax_energy.hpp"

namespace tushar::mpm::gas::paper {

template <int D>
void GasMpm<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.newParticles("mpm::createParticles", createParticles<D>, materials_, creates(p::x<D>), creates(p::velocity<D>),
                     creates(p::density), creates(p::internalEnergy));
  tasks.perMaterial("mpm::computePressure", computeInitialPressure<D>, materials_, requiresNew(p::density),
                    requiresNew(p::internalEnergy), computes(p::pressure));
  tasks.perMaterial("mpm::shareCellVolume", shareCellVolume<D>, materials_, requiresNew(p::density), computes(p::mass));
}

template <int D>
void GasMpm<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeStableTimeStep", computeStableTimeStep<D>, materials_, with(method_.cfl),
                    requiresOld(p::velocity<D>), requiresOld(p::internalEnergy), computes(delT));
}

template <int D>
void GasMpm<D>::scheduleTimeAdvance(TaskList& tasks) const {
  scheduleInterpolateParticlesToGrid(tasks);
  scheduleComputeInternalForce(tasks);
  scheduleComputeAndIntegrateAcceleration(tasks);
  scheduleUpdateParticles(tasks);
  scheduleRelaxEnergy(tasks, materials_);
  tasks.relocate(p::x<D>, materials_);
  if (method_.redistribute) scheduleRedistribute(tasks);
  if (method_.densityFilter) scheduleFilterDensity(tasks);
  scheduleComputePressure(tasks);
}

template <int D>
void GasMpm<D>::scheduleInterpolateParticlesToGrid(TaskList& tasks) const {
  tasks.perMaterial("mpm::interpolateParticlesToGrid", interpolateParticlesToGrid<Shape>, materials_,
                    requiresOld(p::x<D>, Shape::reach), requiresOld(p::mass, Shape::reach),
                    requiresOld(p::velocity<D>, Shape::reach), computes(g::mass), computes(g::velocity<D>));
}

template <int D>
void GasMpm<D>::scheduleComputeInternalForce(TaskList& tasks) const {
  if (conserves())
    tasks.perMaterial("mpm::computeInternalForce", computeInternalForceOfVolumes<Shape>, materials_,
                      requiresOld(p::pressure, Shape::reach), requiresOld(p::mass, Shape::reach),
                      requiresOld(p::density, Shape::reach), computes(g::internalForce<D>));
  else
    tasks.perMaterial("mpm::computeInternalForce", computeInternalForce<Shape>, materials_,
                      requiresOld(p::pressure, Shape::reach), computes(g::internalForce<D>));
}

template <int D>
void GasMpm<D>::scheduleComputeAndIntegrateAcceleration(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeAndIntegrateAcceleration", computeAndIntegrateAcceleration<D>, materials_,
                    requiresNew(g::mass), requiresNew(g::internalForce<D>), requiresNew(g::velocity<D>),
                    requiresOld(delT), computes(g::acceleration<D>), computes(g::velocityStar<D>));
  tasks.perMaterial("mpm::setGridBoundaryConditions", setGridBoundaryConditions<D>, materials_,
                    modifies(g::acceleration<D>), modifies(g::velocityStar<D>));
}

template <int D>
void GasMpm<D>::scheduleUpdateParticles(TaskList& tasks) const {
  if (conserves())
    tasks.perMaterial("mpm::updateParticles", updateParticlesConserving<Shape>, materials_, requiresOld(p::x<D>),
                      requiresOld(p::velocity<D>), requiresOld(p::mass), requiresOld(p::density),
                      requiresOld(p::internalEnergy), requiresOld(p::pressure), requiresNew(g::acceleration<D>),
                      requiresNew(g::velocityStar<D>), requiresOld(delT), computes(p::x<D>), computes(p::velocity<D>),
                      computes(p::density), computes(p::internalEnergy), computes(p::velocityDivergence));
  else
    tasks.perMaterial("mpm::updateParticles", updateParticles<Shape>, materials_, requiresOld(p::x<D>),
                      requiresOld(p::velocity<D>), requiresOld(p::density), requiresOld(p::internalEnergy),
                      requiresOld(p::pressure), requiresNew(g::acceleration<D>), requiresNew(g::velocityStar<D>),
                      requiresOld(delT), computes(p::x<D>), computes(p::velocity<D>), computes(p::density),
                      computes(p::internalEnergy), computes(p::velocityDivergence));
}

template <int D>
void GasMpm<D>::scheduleRedistribute(TaskList& tasks) const {
  const int reach = method_.redistribute->mode == Redistribution::Mode::reseed ? 1 : 0;
  if (conserves())
    tasks.newParticles("mpm::redistribute", redistributeTracked<D>, materials_, with(*method_.redistribute),
                       requiresNew(data::particleId, reach), requiresNew(p::x<D>, reach),
                       requiresNew(p::velocity<D>, reach), requiresNew(p::mass, reach), requiresNew(p::density, reach),
                       requiresNew(p::internalEnergy, reach), requiresNew(p::velocityDivergence, reach),
                       creates(p::x<D>), creates(p::velocity<D>), creates(p::mass), creates(p::density),
                       creates(p::internalEnergy), creates(p::velocityDivergence));
  else
    tasks.newParticles("mpm::redistribute", redistribute<D>, materials_, with(*method_.redistribute),
                       requiresNew(data::particleId, reach), requiresNew(p::x<D>, reach),
                       requiresNew(p::velocity<D>, reach), requiresNew(p::density, reach),
                       requiresNew(p::internalEnergy, reach), requiresNew(p::velocityDivergence, reach),
                       creates(p::x<D>), creates(p::velocity<D>), creates(p::density), creates(p::internalEnergy),
                       creates(p::velocityDivergence));
}

template <int D>
void GasMpm<D>::scheduleFilterDensity(TaskList& tasks) const {
  tasks.perMaterial("mpm::averageDensity", averageDensity<D>, materials_, requiresNew(p::density),
                    computes(c::density));
  tasks.perMaterial("mpm::filterDensity", filterDensity<D>, materials_, requiresNew(c::density, 1),
                    modifies(p::density));
}

template <int D>
void GasMpm<D>::scheduleComputePressure(TaskList& tasks) const {
  tasks.perMaterial("mpm::computePressure", computePressure<D>, materials_, with(method_.viscosity),
                    requiresNew(p::density), requiresNew(p::internalEnergy), requiresNew(p::velocityDivergence),
                    computes(p::pressure));
  if (!conserves())
    tasks.perMaterial("mpm::shareCellVolume", shareCellVolume<D>, materials_, requiresNew(p::density),
                      computes(p::mass));
}

template <int D>
void GasMpm<D>::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perMaterial("mpm::sumMass", sumMass<D>, materials_, requiresOld(p::mass), computes(total::mass));
  tasks.perMaterial("mpm::sumMomentum", sumMomentum<D>, materials_, requiresOld(p::mass), requiresOld(p::velocity<D>),
                    computes(total::momentum));
  tasks.perMaterial("mpm::sumEnergy", sumEnergy<D>, materials_, requiresOld(p::mass), requiresOld(p::velocity<D>),
                    requiresOld(p::internalEnergy), computes(total::kineticEnergy), computes(total::internalEnergy),
                    computes(total::energy));
  tasks.perMaterial("mpm::sumCenterOfMass", sumCenterOfMass<D>, materials_, requiresOld(p::mass), requiresOld(p::x<D>),
                    computes(total::centerOfMass));
  tasks.perMaterial("mpm::findLeast", findLeast, materials_, requiresOld(p::density), requiresOld(p::internalEnergy),
                    computes(total::leastDensity), computes(total::leastEnergy));
  tasks.perMaterial("mpm::sumEntropy", sumEntropy<D>, materials_, requiresOld(p::mass), requiresOld(p::density),
                    requiresOld(p::internalEnergy), computes(total::entropy));
  tasks.perMaterial("mpm::computeVolume", computeVolume, materials_, requiresOld(p::mass), requiresOld(p::density),
                    computes(p::volume));
}

template <int D>
void GasMpm<D>::scheduleMeasureError(TaskList& tasks, const reference::GasReference& exact,
                                     const reference::Clock& clock) const {
  tasks.perMaterial("mpm::measureParticleError", measureParticleError<D>, materials_, with(&exact), with(&clock),
                    requiresOld(p::x<D>), requiresOld(p::density), requiresOld(p::velocity<D>),
                    requiresOld(p::internalEnergy), computes(reference::particleError.density),
                    computes(reference::particleError.velocity), computes(reference::particleError.pressure),
                    computes(reference::particleError.energy));
  tasks.perMaterial("mpm::measureCellError", measureCellError<D>, materials_, with(&exact), with(&clock),
                    requiresOld(p::density), requiresOld(p::velocity<D>), requiresOld(p::internalEnergy),
                    computes(reference::cellError.density), computes(reference::cellError.velocity),
                    computes(reference::cellError.pressure), computes(reference::cellError.energy));
  tasks.perMaterial("mpm::projectMass", interpolateMassToGrid<Shape>, materials_, requiresOld(p::x<D>, Shape::reach),
                    requiresOld(p::mass, Shape::reach), computes(g::mass));
  tasks.perMaterial("mpm::measureNodeError", measureNodeError<D>, materials_, with(&exact), with(&clock),
                    requiresNew(g::mass), computes(reference::nodeError));
}

template class GasMpm<1>;
template class GasMpm<2>;
template class GasMpm<3>;

}  // namespace tushar::mpm::gas::paper
