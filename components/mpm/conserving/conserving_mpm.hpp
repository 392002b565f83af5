#pragma once

#include "components/mpm/conserving/labels.hpp"
#include "components/mpm/gas_dynamics.hpp"
#include "components/mpm/materials/gas.hpp"
#include "components/reference/gas_solution.hpp"

namespace tushar::mpm {

/// The `conserving_gas_dynamics` section.
struct ConservingGasDynamics {
  double cfl = 0.5;
  double longestParticle = 2.5;  ///< cells; longer ones are halved
  Viscosity viscosity{1.0, 0.5};
};

/// A particle method for gas that conserves mass and total energy to round-off and keeps densities and energies
/// positive, in one dimension. Particles are intervals of constant mass that tile the gas, so that no cell empties;
/// they carry a velocity, its slope, and the kinetic energy of the motion about the mean (as in the affine
/// particle-in-cell method of Jiang et al., ACM Trans. Graph. 34 (2015) 51), and touch the grid with their whole length
/// (as in GIMP, Bardenhagen & Kober, CMES 5 (2004) 477). The grid's state is gathered at the end of a step, so that the
/// next time step may follow from it.
class ConservingMpm : public Component, public reference::GasSolution {
 public:
  ConservingMpm(const ConservingGasDynamics& method, std::vector<Gas> materials)
      : method_(method), materials_(std::move(materials)) {}

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  void scheduleMeasureError(TaskList& tasks, const reference::GasReference& reference,
                            const reference::Clock& clock) const override;

 private:
  void scheduleRedistribute(TaskList& tasks) const;
  void scheduleGridState(TaskList& tasks) const;

  ConservingGasDynamics method_;
  std::vector<Gas> materials_;
};

}  // namespace tushar::mpm
