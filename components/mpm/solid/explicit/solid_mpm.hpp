#pragma once

#include "components/mpm/solid/explicit/explicit_tasks.hpp"
#include "components/mpm/solid/explicit/solids_of.hpp"
#include "core/simulation/between_materials.hpp"
#include "core/simulation/careful_steps.hpp"

namespace tushar::mpm::solid {

/// The Material Point Method for solids: Sulsky, Chen & Schreyer, Comput. Methods Appl. Mech. Engrg. 118 (1994) 179,
/// with the steps in Uintah's order and stresses updated last.
///
/// solid_mpm.cpp contains the schedule and can be read as the method; the bodies of its tasks are in tasks/. Tasks that
/// use shape functions come from the interpolator's module; all others are in solids_of.cpp.
template <int D>
class SolidMpm : public SolidsOf<D>, public simulation::CarefulSteps, public simulation::MovesBetweenMaterials {
 public:
  /// `bodies` must outlive this object.
  SolidMpm(Problem problem, const ExplicitTasks<D>& bodies)
      : Base(std::move(problem), bodies.shaped.shape), bodies_(&bodies) {}

  void scheduleTimeAdvance(TaskList& tasks) const override;
  /// Adds a step with `stress_update` musl in place of usl. Where a node has little mass, the velocity v* that changes
  /// F and the stress with usl may be far larger than that of any particle; with musl it is a mean of their velocities.
  void scheduleCarefulTimeAdvance(TaskList& tasks) const override;
  std::string aboutCarefulSteps() const override;
  void scheduleNextMaterials(TaskList& tasks) const override;

 private:
  using Base = SolidsOf<D>;
  using Base::clearsAllNodes, Base::frictionHasColor, Base::hasFriction, Base::hasPlanes, Base::hasZones,
      Base::isLoaded, Base::keeps, Base::keepsSizes, Base::rubbingHeats, Base::transmitsForce;
  using Base::keeps_stress_, Base::problem_, Base::shapes_;
  using Base::scheduleApplyExternalLoads, Base::scheduleContact, Base::scheduleContactAtEnd, Base::scheduleCornerLoads,
      Base::scheduleDamage, Base::scheduleEndOfStep, Base::scheduleFriction, Base::scheduleHeatFlux,
      Base::scheduleKeepVelocity, Base::scheduleNodalWork, Base::scheduleShareTemperature,
      Base::scheduleSurroundingForce, Base::scheduleTemperatureRate;

  void scheduleStep(TaskList& tasks, StressUpdate stressUpdate) const;
  void scheduleShowOnGrid(TaskList& tasks, Reads stressed) const override;
  void scheduleMomentum(TaskList& tasks, Reads stressed) const;
  void scheduleInterpolateParticlesToGrid(TaskList& tasks, Reads stressed) const;
  void scheduleMoveParticles(TaskList& tasks, Reads shaped) const;
  void scheduleVelocityUpdate(TaskList& tasks, Reads shaped) const;
  void scheduleInterpolateMomentum(TaskList& tasks, Reads moving) const;
  void scheduleMeasureWork(TaskList& tasks, Reads shaped) const;
  void scheduleComputeStressTensor(TaskList& tasks, const NodeLabel<NodeRecord>& record) const;
  void scheduleUpdateInCells(TaskList& tasks) const;
  void scheduleComputeSurface(TaskList& tasks, const NodeLabel<NodeRecord>& record) const;
  void scheduleIntegrateAcceleration(TaskList& tasks) const;
  void schedulePrescribedMotion(TaskList& tasks, const NodeLabel<NodeRecord>& record) const;
  void scheduleSeparateBodies(TaskList& tasks) const;
  void scheduleTransmittedForce(TaskList& tasks) const;
  void scheduleUpdateParticles(TaskList& tasks) const;
  void scheduleHeat(TaskList& tasks) const;

  /// The access to the F that shape functions follow, if they do; `reads` selects the old or the new F.
  auto shapedBy(Reads reads, int ghost = 0) const { return when(shapes_.deform, reads(p::deformationMeasure, ghost)); }

  const ExplicitTasks<D>* bodies_;
};

extern template class SolidMpm<1>;
extern template class SolidMpm<2>;
extern template class SolidMpm<3>;

}  // namespace tushar::mpm::solid
