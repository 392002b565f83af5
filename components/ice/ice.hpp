#pragma once

#include "components/euler/diffusion.hpp"
#include "components/euler/euler.hpp"
#include "components/ice/face_flow.hpp"
#include "components/ice/gas_input.hpp"
#include "components/ice/labels.hpp"
#include "components/ice/tracers/tracers.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::ice {

/// A compressible gas with the input of Uintah's ICE: the schedule of `euler`, followed by viscosity, heat conduction
/// and gravity if the scene has them.
template <int D>
class Ice : public euler::Euler<D> {
 public:
  explicit Ice(const GasScene& scene)
      : euler::Euler<D>(scene.gas),
        acting_{.diffusion = {scene.viscosity, scene.conductivity}, .gravity = scene.gravity, .push = scene.push},
        varying_(scene.varying),
        heating_(scene.heating) {
    if (varying_.varies()) acting_.diffusion = {};
    for (const ScalarSettings& one : scene.scalars) scalars_.push_back(std::make_shared<const CarriedScalar>(one));
    tracers_ = tracersOf(scene.tracers, {scene.gas.name}, scalars_, false);
    if (!scene.implicit) return;
    acting_.soundSpeedKnob = scene.implicit->soundSpeedKnob;
    acting_.solver = scene.implicit->solver;
  }

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  std::string advice() const override { return adviceForGas; }
  bool mayRepeatStep() const override { return true; }
  std::vector<std::string> foreignLabels() const override;
  simulation::OtherNames otherNames() const override;
  std::vector<std::string> gasNames() const override { return {this->settings().name}; }
  std::string whyOneLevel() const override { return tracers_ ? tracersOnOneLevel : euler::Euler<D>::whyOneLevel(); }
  std::vector<simulation::Reported> reported() const override;

 protected:
  const IceSettings& acting() const { return acting_; }
  const euler::VaryingDiffusion& varying() const { return varying_; }
  bool keepsFaceMasses() const override { return !scalars_.empty(); }
  std::vector<const data::Label*> carried() const override {
    std::vector<const data::Label*> labels;
    for (const auto& one : scalars_) labels.push_back(&one->held());
    return labels;
  }
  /// Adds the tasks that advect scalars after the step of the gas.
  void scheduleScalars(TaskList& tasks) const;
  /// Adds the tasks that move and make tracers, at the end of the step.
  void scheduleTracers(TaskList& tasks) const;
  /// Adds the tasks that limit the time step because of scalars.
  void scheduleStepsOfScalars(TaskList& tasks) const;
  /// Adds viscosity, conduction and heat, after the step of the gas.
  void scheduleDiffusion(TaskList& tasks) const;
  /// Adds the task that limits explicit steps by a varying viscosity, together with the speed of sound.
  void scheduleStepsOfDiffusion(TaskList& tasks) const;

 private:
  CarriedScalars scalars_;
  std::shared_ptr<const TracersOfGases> tracers_;  ///< null if there are none
  IceSettings acting_;  ///< settings of the step; they contain the diffusion only if it is uniform
  euler::VaryingDiffusion varying_;
  Heating heating_;
};

/// A gas with implicit steps. The pressure at the end of a step solves a linear system; it determines the flow of mass,
/// momentum and energy.
template <int D>
class ImplicitIce : public Ice<D> {
 public:
  using Ice<D>::Ice;

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  std::string whyOneLevel() const override { return pressureOnOneLevel; }
  std::vector<simulation::Reported> reported() const override {
    std::vector<simulation::Reported> all = Ice<D>::reported();
    all.push_back(simulation::iterationsOfRun(total::iterations));
    return all;
  }
};

extern template class Ice<1>;
extern template class Ice<2>;
extern template class Ice<3>;
extern template class ImplicitIce<1>;
extern template class ImplicitIce<2>;
extern template class ImplicitIce<3>;

/// Describes this component to sus.
simulation::ComponentKind kind();

}  // namespace tushar::ice
