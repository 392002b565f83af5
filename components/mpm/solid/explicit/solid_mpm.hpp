#pragma once

#include "components/mpm/shapes/tensor_shape.hpp"
#include "components/mpm/solid/explicit/keeps.hpp"
#include "components/mpm/solid/problem.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// The Material Point Method for solids: Sulsky, Chen & Schreyer, Comput. Methods Appl. Mech. Engrg. 118 (1994) 179,
/// step by step as Uintah takes it, stress last.
///
/// schedule.hpp is the schedule and reads as the method; the bodies of its tasks are in tasks/.
template <class Shape>
class SolidMpm : public Solids {
 public:
  explicit SolidMpm(Problem problem);

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  bool measuresWork() const override { return true; }

 private:
  static constexpr int D = Shape::dimension;

  template <class Reads>
  void scheduleMomentum(TaskList& tasks, Reads stressed) const;
  template <class Reads>
  void scheduleInterpolateParticlesToGrid(TaskList& tasks, Reads stressed) const;
  template <class Reads>
  void scheduleMoveParticles(TaskList& tasks, Reads shaped) const;
  template <class Reads>
  void scheduleVelocityUpdate(TaskList& tasks, Reads shaped) const;
  template <class Reads>
  void scheduleInterpolateMomentum(TaskList& tasks, Reads moving) const;
  template <class Reads>
  void scheduleMeasureWork(TaskList& tasks, Reads shaped) const;
  void scheduleStrainWork(TaskList& tasks) const;
  void scheduleKeepVelocity(TaskList& tasks, const NodeLabel<Vec<D>>& kept) const;
  void scheduleComputeStressTensor(TaskList& tasks, const NodeLabel<NodeRecord>& record) const;
  void scheduleUpdateInCells(TaskList& tasks) const;
  void scheduleComputeSurface(TaskList& tasks) const;
  void scheduleFriction(TaskList& tasks, const std::string& name, Moment moment, const NodeLabel<NodeRecord>& record,
                        bool heats = false) const;
  void scheduleIntegrateAcceleration(TaskList& tasks) const;
  void schedulePrescribedMotion(TaskList& tasks, const NodeLabel<NodeRecord>& record) const;
  void scheduleSeparateBodies(TaskList& tasks) const;
  void scheduleContact(TaskList& tasks, const std::string& name, Moment moment,
                       const NodeLabel<NodeRecord>& record) const;
  void scheduleContactAtEnd(TaskList& tasks) const;
  void scheduleTransmittedForce(TaskList& tasks) const;
  void scheduleApplyExternalLoads(TaskList& tasks) const;
  void scheduleUpdateParticles(TaskList& tasks) const;
  void scheduleHeat(TaskList& tasks) const;
  void scheduleDamage(TaskList& tasks) const;
  void scheduleNonlocalPlasticity(TaskList& tasks) const;

  bool isViscous() const { return problem_.method.viscosity.has_value(); }
  template <class Holds>
  bool anyContact(Holds&& holds) const {
    return std::any_of(problem_.contacts.begin(), problem_.contacts.end(), holds);
  }
  bool hasFriction() const {
    return anyContact([](const Contact& contact) { return contact.type == Contact::Type::friction; });
  }
  bool hasPlanes() const {
    return anyContact([](const Contact& contact) { return contact.usesPlanes(); });
  }
  bool frictionHasColor() const {
    return anyContact([](const Contact& contact) { return !contact.frictionOfColor.empty(); });
  }
  bool rubbingHeats() const { return hasFriction() && problem_.method.contactHeats && problem_.method.conductsHeat; }
  bool transmitsForce() const {
    return std::any_of(problem_.materials.begin(), problem_.materials.end(),
                       [](const Material& material) { return material.transmitsForce; });
  }
  /// Whether nodes that no particle touches must be 0, as other tasks than the solids' own read them.
  bool clearsAllNodes() const {
    return !problem_.contacts.empty() || problem_.method.loadsAtCorners || problem_.surroundings;
  }
  bool isLoaded() const { return problem_.start.loads.hasForces() || problem_.start.solution || transmitsForce(); }
  KeptSizes keepsSizes() const {
    const bool domains = Shape::deforms && problem_.method.keepsDomains;
    return {Shape::hasSize && problem_.method.keepsSizes && !domains, domains};
  }
  /// The sizes of particles as boxes, whether or not the shape functions use them.
  KeptSizes boxSizes() const {
    const Method& method = problem_.method;
    return {method.keepsSizes && !method.keepsDomains, method.keepsDomains};
  }
  Keeps keeps() const {
    return {.sizes = keepsSizes(),
            .stress = keeps_stress_,
            .temperature = is_thermal_,
            .temperatureChange = heats_,
            .failure = is_damageable_,
            .viscosity = isViscous(),
            .externalForce = isLoaded(),
            .stateSize = state_size_,
            .state = &state_};
  }
  /// The F by which shape functions deform, if they do; `reads` selects the old or the new one.
  template <class Reads>
  static auto shapedBy(Reads reads, int ghost = 0) {
    return when(Shape::deforms, reads(p::deformationMeasure, ghost));
  }

  bool keeps_stress_ = false;   ///< some material's stress is not a function of F alone
  bool is_thermal_ = false;     ///< some material's stress depends on the temperature
  bool is_damageable_ = false;  ///< particles of some material may fail
  bool heats_ = false;          ///< the work of a step changes the temperature
};

}  // namespace tushar::mpm::solid
