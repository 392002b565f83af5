#pragma once

#include "components/mpm/solid/explicit/keeps.hpp"
#include "components/mpm/solid/problem.hpp"
#include "components/mpm/solid/transfer/node_record.hpp"
#include "components/mpm/solid/transfer/placed.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// Selects whether variables are read from the start of the step, or as computed in the step.
struct Reads {
  bool isNew;

  auto operator()(const auto& label, int ghost = 0) const {
    return isNew ? requiresNew(label, ghost) : requiresOld(label, ghost);
  }
};
inline constexpr Reads readsOld{false}, readsNew{true};

/// The part of SolidMpm that does not depend on shape functions.
template <int D>
class SolidsOf : public Solids {
 public:
  SolidsOf(Problem problem, const ShapeTraits& shapes);

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  bool measuresWork() const override { return true; }
  std::string whyOneLevel() const override;
  std::string whyOneBox() const override;

 protected:
  /// Adds forces, volumes and stresses on the nodes, for outputs and measurements.
  virtual void scheduleShowOnGrid(TaskList& tasks, Reads stressed) const = 0;
  void scheduleApplyExternalLoads(TaskList& tasks) const;
  void scheduleCornerLoads(TaskList& tasks) const;
  void scheduleContact(TaskList& tasks, const std::string& name, Moment moment,
                       const NodeLabel<NodeRecord>& record) const;
  void scheduleContactAtEnd(TaskList& tasks) const;
  void scheduleFriction(TaskList& tasks, const std::string& name, Moment moment, const NodeLabel<NodeRecord>& record,
                        bool heats = false) const;
  void scheduleSurroundingForce(TaskList& tasks) const;
  void scheduleKeepVelocity(TaskList& tasks, const NodeLabel<Vec<D>>& kept) const;
  void scheduleNodalWork(TaskList& tasks) const;
  void scheduleHeatFlux(TaskList& tasks) const;
  void scheduleShareTemperature(TaskList& tasks) const;
  void scheduleTemperatureRate(TaskList& tasks) const;
  void scheduleDamage(TaskList& tasks) const;
  void scheduleEndOfStep(TaskList& tasks) const;
  void scheduleStrainWork(TaskList& tasks) const;
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
  bool hasZones() const { return !problem_.zones.empty(); }
  bool rubbingHeats() const { return hasFriction() && problem_.method.contactHeats && problem_.method.conductsHeat; }
  bool transmitsForce() const {
    return std::any_of(problem_.materials.begin(), problem_.materials.end(),
                       [](const Material& material) { return material.transmitsForce; });
  }
  /// Whether untouched nodes must be 0, because contacts or tasks other than those of the solids read them.
  bool clearsAllNodes() const {
    return anyContact([](const Contact& contact) { return contact.readsAllNodes(); }) ||
           problem_.method.loadsAtCorners || problem_.surroundings || hasZones();
  }
  bool isLoaded() const { return problem_.start.loads.hasForces() || problem_.start.solution || transmitsForce(); }
  KeptSizes keepsSizes() const {
    const bool domains = shapes_.deform && problem_.method.keepsDomains;
    return {shapes_.haveSizes && problem_.method.keepsSizes && !domains, domains, problem_.method.longestDiagonal};
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

  ShapeTraits shapes_;
  bool keeps_stress_ = false;   ///< whether some material's stress is not a function of F alone
  bool is_thermal_ = false;     ///< whether some material's stress depends on the temperature
  bool is_damageable_ = false;  ///< whether particles of some material may fail
  bool heats_ = false;          ///< whether the work of a step changes the temperature
};

extern template class SolidsOf<1>;
extern template class SolidsOf<2>;
extern template class SolidsOf<3>;

}  // namespace tushar::mpm::solid
