#pragma once

#include "components/mpm/shapes/tensor_shape.hpp"
#include "components/mpm/solid/explicit/solids_of.hpp"

namespace tushar::mpm::solid {

/// The Material Point Method for solids: Sulsky, Chen & Schreyer, Comput. Methods Appl. Mech. Engrg. 118 (1994) 179,
/// step by step as Uintah takes it, stress last.
///
/// schedule.hpp is the schedule and reads as the method; the bodies of its tasks are in tasks/. What does not depend on
/// the shape functions is in solids_of.cpp.
template <class Shape>
class SolidMpm : public SolidsOf<Shape::dimension> {
 public:
  explicit SolidMpm(Problem problem)
      : Base(std::move(problem),
             {.haveSizes = Shape::hasSize, .deform = Shape::deforms, .reach = static_cast<int>(Shape::reach)}) {}

  void scheduleTimeAdvance(TaskList& tasks) const override;

 private:
  static constexpr int D = Shape::dimension;
  using Base = SolidsOf<D>;
  using Base::clearsAllNodes, Base::frictionHasColor, Base::hasFriction, Base::hasPlanes, Base::isLoaded, Base::keeps,
      Base::keepsSizes, Base::rubbingHeats, Base::transmitsForce;
  using Base::keeps_stress_, Base::problem_;
  using Base::scheduleApplyExternalLoads, Base::scheduleContact, Base::scheduleContactAtEnd, Base::scheduleCornerLoads,
      Base::scheduleDamage, Base::scheduleEndOfStep, Base::scheduleFriction, Base::scheduleHeatFlux,
      Base::scheduleKeepVelocity, Base::scheduleNodalWork, Base::scheduleSurroundingForce,
      Base::scheduleTemperatureRate;

  void scheduleShowOnGrid(TaskList& tasks, Reads stressed) const override;
  void scheduleMomentum(TaskList& tasks, Reads stressed) const;
  void scheduleInterpolateParticlesToGrid(TaskList& tasks, Reads stressed) const;
  void scheduleMoveParticles(TaskList& tasks, Reads shaped) const;
  void scheduleVelocityUpdate(TaskList& tasks, Reads shaped) const;
  void scheduleInterpolateMomentum(TaskList& tasks, Reads moving) const;
  void scheduleMeasureWork(TaskList& tasks, Reads shaped) const;
  void scheduleComputeStressTensor(TaskList& tasks, const NodeLabel<NodeRecord>& record) const;
  void scheduleUpdateInCells(TaskList& tasks) const;
  void scheduleComputeSurface(TaskList& tasks) const;
  void scheduleIntegrateAcceleration(TaskList& tasks) const;
  void schedulePrescribedMotion(TaskList& tasks, const NodeLabel<NodeRecord>& record) const;
  void scheduleSeparateBodies(TaskList& tasks) const;
  void scheduleTransmittedForce(TaskList& tasks) const;
  void scheduleUpdateParticles(TaskList& tasks) const;
  void scheduleHeat(TaskList& tasks) const;

  /// The F by which shape functions deform, if they do; `reads` selects the old or the new one.
  static auto shapedBy(Reads reads, int ghost = 0) { return when(Shape::deforms, reads(p::deformationMeasure, ghost)); }
};

}  // namespace tushar::mpm::solid
