#pragma once

#include "components/ice/gas_input.hpp"
#include "components/ice/mixture/labels.hpp"
#include "components/mpm/solid/problem.hpp"
#include "components/mpmice/gas_in_cells.hpp"
#include "components/mpmice/settings.hpp"

namespace tushar::mpmice {

/// A gas in the space around bodies of particles, in D dimensions, by finite volumes with walls.
///
/// The schedule of the solids calls the functions of this class, which add the tasks of the gas among those of the
/// solids. They are in mpmice.cpp and schedule_*.cpp.
template <int D>
class GasAround : public mpm::solid::Surroundings {
 public:
  using Materials = std::vector<mpm::solid::Material>;

  explicit GasAround(Settings settings);

  std::vector<std::string> gasNames() const;
  const ice::CarriedScalars& scalars() const { return scalars_; }
  /// The tracers of the gases; null if there are none.
  const ice::TracersOfGases* tracers() const { return tracers_.get(); }
  bool exchangesHeat() const override { return hasHeat() || burns(); }
  void scheduleStart(TaskList& tasks, const Materials& materials) const override;
  void scheduleForces(TaskList& tasks, const Materials& materials, const ParticleLabel<double>& state) const override;
  void scheduleMotion(TaskList& tasks, const Materials& materials) const override;
  void scheduleRelocation(TaskList& tasks, const Materials& materials) const override;
  /// Adds the tasks that make tracers, after all other tasks of a step.
  void scheduleNewTracers(TaskList& tasks, const Materials& materials) const;
  void scheduleStableTimeStep(TaskList& tasks, const Materials& materials) const;
  void scheduleDiagnostics(TaskList& tasks, const Materials& materials) const;
  std::vector<simulation::Reported> reported() const;
  void scheduleErrorEstimate(TaskList& tasks) const;
  void scheduleRefine(TaskList& tasks) const;
  bool areBodiesRigid() const { return settings_.areRigid; }
  bool isImplicit() const { return settings_.implicit.has_value(); }
  /// Whether each cell measures the time for which a flame has been beside it.
  bool waitsForFlames() const { return hasCracks() && settings_.burning->model.ddt()->induction; }

 private:
  /// The gas in cells; `reads` selects the kind of access.
  auto gasIn(auto reads, typename GasInCells<D>::Reach reach) const {
    reach.gases = settings_.gases.size();
    reach.endsAtPlane = settings_.endsAtPlane;
    return all<GasInCells<D>>(reads, reach);
  }
  bool hasHeat() const { return settings_.heat.act(); }
  bool conductsToBodies() const { return settings_.diffusion.conducts() && hasHeat(); }
  void scheduleHeat(TaskList& tasks, const Materials& materials) const;
  template <int Most>
  void scheduleExchange(TaskList& tasks, const Materials& materials) const;
  void scheduleConduction(TaskList& tasks, const Materials& materials) const;
  /// Whether walls slow the gas along them. In one dimension, nothing is along a wall.
  bool hasFriction() const { return D > 1 && settings_.hasFriction(); }
  /// Whether the friction depends on the state of a cell.
  bool variesFriction() const {
    return hasFriction() && (settings_.diffusion.varies() || (settings_.drag.acts() && !settings_.gases.empty()));
  }
  void schedulePressure(TaskList& tasks, const Materials& materials) const;
  bool burns() const { return settings_.burning.has_value(); }
  bool hasCracks() const { return burns() && settings_.burning->model.ddt(); }
  bool isUnsteady() const { return burns() && settings_.burning->model.unsteady(); }
  /// Whether the burning body has strain energy, which must be added to the gas.
  bool keepsStrain(const Materials& materials) const;
  void scheduleBurning(TaskList& tasks, const Materials& materials, const ParticleLabel<double>& state) const;
  void scheduleBoxes(TaskList& tasks, const Materials& materials) const;
  void scheduleSums(TaskList& tasks, const Materials& materials) const;
  void scheduleEnergy(TaskList& tasks, const Materials& materials) const;
  /// Adds the tasks that advect scalars with the gas: before small cells are merged, and after.
  void carryScalars(TaskList& tasks) const;
  void shareScalars(TaskList& tasks) const;
  /// The tracers as materials that follow the bodies.
  auto tracersAfter(const Materials& materials) const { return following(materials, tracers_->ofGases()); }

  Settings settings_;
  std::vector<std::shared_ptr<const ice::GasTotal>> totals_;  ///< totals of each gas, if there are several
  ice::CarriedScalars scalars_;
  std::shared_ptr<const ice::TracersOfGases> tracers_;  ///< null if there are none
};

/// Solids and a gas on the same grid.
template <int D>
class MpmIce : public Component {
 public:
  /// `gas` surrounds `solids`.
  MpmIce(std::shared_ptr<const GasAround<D>> gas, std::unique_ptr<mpm::solid::Solids> solids)
      : gas_(std::move(gas)), solids_(std::move(solids)) {}

  void scheduleInitialize(TaskList& tasks) const override { solids_->scheduleInitialize(tasks); }
  void scheduleComputeStableTimeStep(TaskList& tasks) const override {
    gas_->scheduleStableTimeStep(tasks, solids_->problem().materials);
  }
  void scheduleTimeAdvance(TaskList& tasks) const override {
    solids_->scheduleTimeAdvance(tasks);
    gas_->scheduleNewTracers(tasks, solids_->problem().materials);
  }
  void scheduleDiagnostics(TaskList& tasks) const override {
    solids_->scheduleDiagnostics(tasks);
    gas_->scheduleDiagnostics(tasks, solids_->problem().materials);
  }
  std::vector<simulation::Reported> reported() const override { return gas_->reported(); }
  void scheduleErrorEstimate(TaskList& tasks) const override { gas_->scheduleErrorEstimate(tasks); }
  void scheduleRefine(TaskList& tasks) const override { gas_->scheduleRefine(tasks); }
  std::string whyOneLevel() const override {
    if (gas_->tracers()) return ice::tracersOnOneLevel;
    if (gas_->waitsForFlames()) return "useInductionTime is not available on several levels; set it to false";
    return gas_->isImplicit() ? ice::pressureOnOneLevel : solids_->whyOneLevel();
  }
  std::string whyOneBox() const override { return gas_->tracers() ? ice::tracersInOneBox : solids_->whyOneBox(); }
  std::string advice() const override;
  bool mayRepeatStep() const override { return true; }
  std::vector<std::string> foreignLabels() const override;
  simulation::OtherNames otherNames() const override;
  std::vector<std::string> gasNames() const override { return gas_->gasNames(); }
  std::vector<InputProblem> notes() const override { return solids_->notes(); }

 private:
  std::shared_ptr<const GasAround<D>> gas_;
  std::unique_ptr<mpm::solid::Solids> solids_;
};

extern template class MpmIce<1>;
extern template class MpmIce<2>;
extern template class MpmIce<3>;

}  // namespace tushar::mpmice
