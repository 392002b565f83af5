#include "components/ice/mixture/implicit_tasks.hpp"
#include "components/ice/mixture/mixture_ice.hpp"

namespace tushar::ice {

template <int D>
ImplicitMixtureIce<D>::ImplicitMixtureIce(const GasScene& scene)
    : MixtureIce<D>(scene),
      acting_{.diffusion = {},
              .gravity = scene.gravity,
              .push = scene.push,
              .soundSpeedKnob = scene.implicit->soundSpeedKnob,
              .solver = scene.implicit->solver} {}

template <int D>
void ImplicitMixtureIce<D>::scheduleInitialize(TaskList& tasks) const {
  MixtureIce<D>::scheduleInitialize(tasks);
  tasks.acrossMaterials("ice::initializePressure", initializeMixedPressure<D>, this->held(),
                        withoutMaterial(requiresNew(euler::c::density)),
                        withoutMaterial(requiresNew(euler::c::momentum<D>)),
                        withoutMaterial(requiresNew(euler::c::totalEnergy)), all<NewShare>(),
                        withoutMaterial(computes(c::pressureAtEnd)));
}

template <int D>
void ImplicitMixtureIce<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.acrossMaterials("ice::limitImplicitStep", limitImplicitMixture<D>, this->held(), with(this->courant()),
                        with(acting_), withoutMaterial(all<euler::OldState<D>>(2)), all<euler::OldGas>(2), startTime(),
                        withoutMaterial(requiresOld(c::pressureAtEnd, 2)), computes(delT));
  this->scheduleStepsOfDiffusion(tasks, acting_.soundSpeedKnob);
}

template <int D>
void ImplicitMixtureIce<D>::scheduleTimeAdvance(TaskList& tasks) const {
  tasks.acrossMaterials("ice::computeLaw", computeLaw<D>, this->held(), all<euler::OldGas>(0),
                        withoutMaterial(computes(c::softness)), withoutMaterial(computes(c::stiffness)));
  tasks.perRank("ice::solvePressure", solveMixedPressure<D>, withWorkers(), with(this->held().front()), with(acting_),
                startTime(), requiresOld(delT), all<LawfulState<D>>(), requiresOld(c::pressureAtEnd),
                all<PressureViews>(), totals<SolveTotals>());
  tasks.acrossMaterials("ice::advanceImplicitly", advanceMixtureImplicitly<D>, this->held(), with(acting_),
                        withoutMaterial(all<euler::OldState<D>>(2)), all<euler::OldGas>(2), startTime(),
                        requiresOld(delT), withoutMaterial(requiresNew(c::pressureChange, 2)),
                        withoutMaterial(all<euler::NewState<D>>()), all<euler::NewGas>());
  this->scheduleSources(tasks);
  this->scheduleHeat(tasks);
  this->scheduleTracers(tasks);
}

template class ImplicitMixtureIce<1>;
template class ImplicitMixtureIce<2>;
template class ImplicitMixtureIce<3>;

}  // namespace tushar::ice
