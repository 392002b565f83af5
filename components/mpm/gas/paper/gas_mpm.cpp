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

/// Adds the tasks that create the state at t_0, including p_p and m_p, which each step reads at its start.
template <int D>
void GasMpm<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.newParticles("mpm::createParticles", createParticles<D>, materials_, creates(p::x<D>), creates(p::velocity<D>),
                     creates(p::density), creates(p::internalEnergy));
  tasks.perMaterial("mpm::computePressure", computeInitialPressure<D>, materials_, requiresNew(p::density),
                    requiresNew(p::internalEnergy), computes(p::pressure));
  scheduleShareCellVolume(tasks);
}

template <int D>
void GasMpm<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeStableTimeStep", computeStableTimeStep<D>, materials_, with(method_.cfl),
                    requiresOld(p::velocity<D>), requiresOld(p::internalEnergy), computes(delT));
}

/// One step from t_n to t_n+1, with the equations of the paper. `requiresOld` reads the state at t_n, `requiresNew` the
/// results of the step. The paper assigns particle masses at the start of a step; this list does so at its end, with
/// the same effect.
template <int D>
void GasMpm<D>::scheduleTimeAdvance(TaskList& tasks) const {
  scheduleInterpolateParticlesToGrid(tasks);                // (6)-(8)    m_i, v_i of t_n
  scheduleComputeInternalForce(tasks);                      // (9)        F_i from p_p of t_n
  scheduleComputeAndIntegrateAcceleration(tasks);           // (10)-(11)  a_i of t_n, v_i of t_n+1
  scheduleUpdateParticles(tasks);                           // (12)-(15)  v_p, x_p, eps_p, rho_p of t_n+1
  scheduleRelaxEnergy(tasks, materials_);                   //            a source of heat, where the scene has one
  tasks.relocate(p::x<D>, materials_);                      //            particles move to their new cells
  if (method_.redistribute) scheduleRedistribute(tasks);    //            particles of crowded and of sparse cells
  if (method_.densityFilter) scheduleFilterDensity(tasks);  // (18)       rho_p, smoothed where it has an extremum
  scheduleComputePressure(tasks);                           // (16)       p_p of t_n+1
  if (!conserves()) scheduleShareCellVolume(tasks);         // (4)-(5)    m_p of t_n+1
}

/// Equations (6)-(8).
template <int D>
void GasMpm<D>::scheduleInterpolateParticlesToGrid(TaskList& tasks) const {
  tasks.perMaterial("mpm::interpolateParticlesToGrid", interpolateParticlesToGrid<D>, materials_,
                    requiresOld(p::x<D>, reach), requiresOld(p::mass, reach), requiresOld(p::velocity<D>, reach),
                    computes(g::mass), computes(g::velocity<D>));
}

/// Equation (9). The pressure p_p is that of the state at t_n, computed with (16) at the end of the previous step: in
/// (11) of the paper, the acceleration from this pressure is called a_i^n.
template <int D>
void GasMpm<D>::scheduleComputeInternalForce(TaskList& tasks) const {
  if (conserves())
    tasks.perMaterial("mpm::computeInternalForce", computeInternalForceOfVolumes<D>, materials_,
                      requiresOld(p::pressure, reach), requiresOld(p::mass, reach), requiresOld(p::density, reach),
                      computes(g::internalForce<D>));
  else
    tasks.perMaterial("mpm::computeInternalForce", computeInternalForce<D>, materials_, requiresOld(p::pressure, reach),
                      computes(g::internalForce<D>));
}

/// Equations (10)-(11), and the boundary conditions for a_i and for v_i at t_n+1.
template <int D>
void GasMpm<D>::scheduleComputeAndIntegrateAcceleration(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeAndIntegrateAcceleration", computeAndIntegrateAcceleration<D>, materials_,
                    requiresNew(g::mass), requiresNew(g::internalForce<D>), requiresNew(g::velocity<D>),
                    requiresOld(delT), computes(g::acceleration<D>), computes(g::velocityStar<D>));
  tasks.perMaterial("mpm::setGridBoundaryConditions", setGridBoundaryConditions<D>, materials_,
                    modifies(g::acceleration<D>), modifies(g::velocityStar<D>));
}

/// Equations (12)-(15).
template <int D>
void GasMpm<D>::scheduleUpdateParticles(TaskList& tasks) const {
  tasks.perMaterial("mpm::updateParticles", conserves() ? updateParticlesConserving<D> : updateParticles<D>, materials_,
                    all<ParticleUpdate<D>>(conserves()), requiresOld(delT));
}

template <int D>
void GasMpm<D>::scheduleRedistribute(TaskList& tasks) const {
  const int ghost = method_.redistribute->mode == Redistribution::Mode::reseed ? 1 : 0;
  tasks.newParticles("mpm::redistribute", redistribute<D>, materials_, with(*method_.redistribute),
                     all<OldParticles<D>>(conserves(), ghost), all<NewParticles<D>>(conserves()));
}

/// Equation (18), for densities.
template <int D>
void GasMpm<D>::scheduleFilterDensity(TaskList& tasks) const {
  tasks.perMaterial("mpm::averageDensity", averageDensity<D>, materials_, requiresNew(p::density),
                    computes(c::density));
  tasks.perMaterial("mpm::filterDensity", filterDensity<D>, materials_, requiresNew(c::density, 1),
                    modifies(p::density));
}

/// Equation (16).
template <int D>
void GasMpm<D>::scheduleComputePressure(TaskList& tasks) const {
  tasks.perMaterial("mpm::computePressure", computePressure<D>, materials_, with(method_.viscosity),
                    requiresNew(p::density), requiresNew(p::internalEnergy), requiresNew(p::velocityDivergence),
                    computes(p::pressure));
}

/// Equations (4)-(5).
template <int D>
void GasMpm<D>::scheduleShareCellVolume(TaskList& tasks) const {
  tasks.perMaterial("mpm::shareCellVolume", shareCellVolume<D>, materials_, requiresNew(p::density), computes(p::mass));
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
                    requiresOld(p::internalEnergy), all<ErrorNorms>(&reference::particleError));
  tasks.perMaterial("mpm::measureCellError", measureCellError<D>, materials_, with(&exact), with(&clock),
                    requiresOld(p::density), requiresOld(p::velocity<D>), requiresOld(p::internalEnergy),
                    all<ErrorNorms>(&reference::cellError));
  tasks.perMaterial("mpm::projectMass", interpolateMassToGrid<D>, materials_, requiresOld(p::x<D>, reach),
                    requiresOld(p::mass, reach), computes(g::mass));
  tasks.perMaterial("mpm::measureNodeError", measureNodeError<D>, materials_, with(&exact), with(&clock),
                    requiresNew(g::mass), computes(reference::nodeError));
}

template class GasMpm<1>;
template class GasMpm<2>;
template class GasMpm<3>;

}  // namespace tushar::mpm::gas::paper
