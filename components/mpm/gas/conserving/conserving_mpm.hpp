#pragma once

#include "components/mpm/gas/conserving/scheme.hpp"
#include "components/mpm/gas/gas_method.hpp"

namespace tushar::mpm::gas::conserving {

/// A particle method for gas in D dimensions that conserves mass, momentum and total energy to round-off and keeps
/// densities and energies positive.
///
/// Particles are boxes of constant mass that tile the gas, so no cell becomes empty. A particle carries a multilinear
/// velocity field (its mean and its modes), the internal energy e, and the kinetic energy K_A of the motion about the
/// mean, as in the affine particle-in-cell method of Jiang et al., ACM Trans. Graph. 34 (2015) 51. It interacts with
/// the grid over its whole box, as in GIMP, Bardenhagen & Kober, CMES 5 (2004) 477: w_i is the mean of the shape
/// function of node i over the box, o_c the fraction of the box in cell c (footprint.hpp).
///
/// From the state of the grid at the start, a step computes the forces and accelerations a_i of the nodes, and the work
/// f_c that exactly these forces do on the gas in each cell (cells.hpp). Then particles get from the grid
/// (transfer.hpp)
///   (E1) new velocity modes: moments of the nodal velocities over the box,
///   (E2) new K_A: the kinetic energy of the motion about the mean,
///   (E3) new e: e (1 + sum_c o_c f_c), and all the kinetic energy that (E1) and (E2) lose.
/// The grid's state is gathered from the particles at the end of a step, so that the next time step can follow from it.
///
/// conserving_mpm.cpp is the schedule; the bodies of its tasks are in the other files of this folder.
template <int D>
class ConservingMpm : public GasMethod<ConservingGasDynamics> {
 public:
  using GasMethod::GasMethod;

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  void scheduleMeasureError(TaskList&, const reference::GasReference&, const reference::Clock&) const override;

 private:
  /// Adds the tasks whose bodies depend on the transfer.
  template <class Scheme>
  void scheduleStep(TaskList& tasks) const;
  template <class Scheme>
  void scheduleComputePressure(TaskList& tasks) const;
  /// Adds tasks for the pressure and signal speeds of a mixture of gases, which share pressure and velocity.
  void scheduleMixtureState(TaskList& tasks) const;
  void scheduleRedistribute(TaskList& tasks) const;
  void scheduleGridState(TaskList& tasks, bool isStart = false) const;
  bool isMixture() const { return materials_.size() > 1; }
};

extern template class ConservingMpm<1>;
extern template class ConservingMpm<2>;
extern template class ConservingMpm<3>;

}  // namespace tushar::mpm::gas::conserving
