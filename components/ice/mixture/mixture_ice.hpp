#pragma once

#include "components/euler/euler.hpp"
#include "components/ice/face_flow.hpp"
#include "components/ice/gas_input.hpp"
#include "components/ice/mixture/diffusion.hpp"
#include "components/ice/mixture/exchange_heat.hpp"
#include "components/ice/mixture/exchange_mass.hpp"
#include "components/ice/mixture/tasks.hpp"
#include "components/ice/tracers/tracers.hpp"

namespace tushar::ice {

/// Several gases with the input of Uintah's ICE, at one velocity and one pressure in each cell. Their state is that of
/// `euler` for all gases together, and the mass and the volume fraction of each gas. See components/euler/mixture.hpp.
template <int D>
class MixtureIce : public Component, public reference::GasSolution {
 public:
  explicit MixtureIce(const GasScene& scene);

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleAfterRefluxing(TaskList& tasks) const override;
  std::vector<std::shared_ptr<const data::JointInterpolation>> jointInterpolations() const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  std::string advice() const override { return adviceForGas; }
  bool mayRepeatStep() const override { return true; }
  std::vector<std::string> foreignLabels() const override;
  simulation::OtherNames otherNames() const override;
  std::vector<simulation::Criterion> criteria() const override { return euler::criteria<D>(); }
  std::vector<std::string> gasNames() const override;
  std::vector<reference::GasLaw> gases() const override;
  void scheduleMeasureError(TaskList& tasks, const reference::GasReference& exact,
                            const reference::Clock& clock) const override;
  std::vector<reference::MeasuredPlace> measuredPlaces() const override { return {reference::MeasuredPlace::cell}; }
  std::string whyOneLevel() const override { return tracers_ ? tracersOnOneLevel : ""; }
  std::vector<simulation::Reported> reported() const override;

 protected:
  const euler::Courant& courant() const { return courant_; }
  const Gases& held() const { return gases_; }
  /// Adds the tasks that change the gases after their flow: conversion into another gas, viscosity, conduction.
  void scheduleSources(TaskList& tasks) const;
  /// Adds the task that limits the time step by diffusion, together with the given fraction of the speed of sound.
  void scheduleStepsOfDiffusion(TaskList& tasks, double soundSpeedKnob) const;
  /// Adds the heat exchange between gases, after all other tasks of the gases.
  void scheduleHeat(TaskList& tasks) const;
  /// Adds the tasks that move and make tracers, at the end of the step.
  void scheduleTracers(TaskList& tasks) const;

 private:
  /// Whether a gas has its own law.
  bool areBlended() const { return gases_.front().blend != nullptr; }
  void scheduleClosing(TaskList& tasks) const;

  euler::Method method_;
  euler::Courant courant_;
  Vec3 gravity_, push_;
  Gases gases_;
  MixtureDiffusion diffusion_;
  std::vector<Transfer> transfers_;
  std::vector<BurningGas> burning_;
  std::vector<Reaction> reactions_;
  HeatCoefficients heat_;
  Heating heating_;
  std::string binary_;     ///< with BinaryProperties, the name of the gas of the scene
  bool isBinary_ = false;  ///< whether the gases are the two parts of a single gas of the scene
  std::vector<std::shared_ptr<const GasTotal>> totals_;
  std::shared_ptr<const TracersOfGases> tracers_;  ///< null if there are none
};

/// Several gases with implicit steps.
template <int D>
class ImplicitMixtureIce : public MixtureIce<D> {
 public:
  explicit ImplicitMixtureIce(const GasScene& scene);

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  std::string whyOneLevel() const override { return pressureOnOneLevel; }
  std::vector<simulation::Reported> reported() const override {
    std::vector<simulation::Reported> all = MixtureIce<D>::reported();
    all.push_back(simulation::iterationsOfRun(total::iterations));
    return all;
  }

 private:
  IceSettings acting_;
};

extern template class MixtureIce<1>;
extern template class MixtureIce<2>;
extern template class MixtureIce<3>;
extern template class ImplicitMixtureIce<1>;
extern template class ImplicitMixtureIce<2>;
extern template class ImplicitMixtureIce<3>;

}  // namespace tushar::ice
