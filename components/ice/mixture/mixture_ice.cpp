#include "components/ice/mixture/mixture_ice.hpp"

#include "components/euler/interpolate_mixture.hpp"
#include "components/euler/tasks/add_gravity.hpp"
#include "components/ice/diagnose.hpp"
#include "components/ice/tracers/schedule.hpp"
#include "components/ice/uintah_words.hpp"

namespace tushar::ice {

namespace {

/// The index of the gas with this name.
std::size_t indexOf(const GasScene& scene, const std::string& name) {
  const auto isIt = [&](const euler::Settings& gas) { return gas.name == name; };
  return static_cast<std::size_t>(std::find_if(scene.mixture.begin(), scene.mixture.end(), isIt) -
                                  scene.mixture.begin());
}

/// The mass exchanges of a scene.
std::vector<Transfer> transfersOf(const GasScene& scene) {
  std::vector<Transfer> transfers;
  for (const MassExchange& one : scene.massExchanges)
    transfers.push_back({indexOf(scene, one.from), indexOf(scene, one.to), one.rate, one.startTime});
  return transfers;
}

std::vector<BurningGas> burningOf(const GasScene& scene) {
  std::vector<BurningGas> burning;
  for (const ProgrammedBurn& one : scene.programs)
    burning.push_back({indexOf(scene, one.from), indexOf(scene, one.to), one});
  return burning;
}

}  // namespace

template <int D>
MixtureIce<D>::MixtureIce(const GasScene& scene)
    : method_(scene.gas.method),
      courant_(scene.gas.courant),
      gravity_(scene.gravity),
      push_(scene.push),
      gases_(scene.mixture),
      diffusion_{scene.diffusions, scene.varying.smagorinsky, scene.binary.has_value()},
      transfers_(transfersOf(scene)),
      burning_(burningOf(scene)),
      reactions_(reactionsOf(scene)),
      heat_(scene.exchange.value_or(Exchange()).heatCoefficients()),
      heating_(scene.heating),
      binary_(scene.gas.name),
      isBinary_(scene.binary.has_value()) {
  for (const euler::Settings& gas : gases_) totals_.push_back(std::make_shared<const GasTotal>(gas.name));
  std::optional<TracerSettings> settings = scene.tracers;
  if (settings && isBinary_) settings->material = gases_.front().name;
  std::vector<std::string> names;
  for (const euler::Settings& gas : gases_) names.push_back(gas.name);
  tracers_ = tracersOf(settings, names, {}, false);
}

template <int D>
void MixtureIce<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.acrossMaterials("ice::initializeMixture", initializeMixture<D>, gases_,
                        withoutMaterial(all<euler::NewState<D>>()), all<euler::NewGas>());
  scheduleStartAlone<D>(tasks, tracers_.get(), gases_.front().gas);
}

template <int D>
void MixtureIce<D>::scheduleTracers(TaskList& tasks) const {
  scheduleStepAlone<D>(tasks, tracers_.get(), gases_.front().gas);
}

template <int D>
std::vector<simulation::Reported> MixtureIce<D>::reported() const {
  if (!tracers_) return {};
  return {numberOfTracers()};
}

template <int D>
void MixtureIce<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.acrossMaterials("ice::limitMixtureStep", euler::limitMixtureStep<D>, gases_, with(courant_),
                        withoutMaterial(all<euler::OldState<D>>(0)), all<euler::OldGas>(0), computes(delT));
  scheduleStepsOfDiffusion(tasks, 1);
}

template <int D>
void MixtureIce<D>::scheduleStepsOfDiffusion(TaskList& tasks, double soundSpeedKnob) const {
  if (diffusion_.acts())
    tasks.acrossMaterials("ice::limitMixtureDiffusion", limitMixtureDiffusion<D>, gases_, with(diffusion_),
                          with(courant_.number), with(soundSpeedKnob), withoutMaterial(all<euler::OldState<D>>(1)),
                          all<euler::OldGas>(1), startTime(), computes(delT));
}

template <int D>
void MixtureIce<D>::scheduleTimeAdvance(TaskList& tasks) const {
  const int ghost = euler::reach(method_);
  tasks.acrossMaterials("ice::advanceMixture", euler::chooseAdvanceMixture<D>(method_, gases_.size()), gases_,
                        withoutMaterial(all<euler::OldState<D>>(ghost)), all<euler::OldGas>(ghost), startTime(),
                        requiresOld(delT), withoutMaterial(all<euler::NewState<D>>()), all<euler::NewGas>(),
                        withoutMaterial(all<euler::RimFluxes<D>>(false)), all<euler::GasRims>());
  scheduleSources(tasks);
  if (!push_.isZero(0))
    tasks.perPatch("euler::addForce", euler::addForce<D>, with(push_), requiresNew(euler::c::density),
                   requiresOld(delT), modifies(euler::c::momentum<D>), modifies(euler::c::totalEnergy));
  if (!gravity_.isZero(0))
    tasks.perPatch("euler::addGravity", euler::addGravity<D>, with(gravity_), requiresNew(euler::c::density),
                   requiresOld(delT), modifies(euler::c::momentum<D>), modifies(euler::c::totalEnergy));
  scheduleHeat(tasks);
  if (areBlended()) scheduleClosing(tasks);
  scheduleTracers(tasks);
}

/// Adds the task that finds the volume fractions of gases with laws of their own. Until then, those of a step are
/// undefined.
template <int D>
void MixtureIce<D>::scheduleClosing(TaskList& tasks) const {
  tasks.acrossMaterials(
      "ice::closeBlend", euler::closeBlend<D>, gases_, withoutMaterial(requiresNew(euler::c::density)),
      withoutMaterial(requiresNew(euler::c::momentum<D>)), withoutMaterial(requiresNew(euler::c::totalEnergy)),
      requiresNew(euler::c::gasMass), modifies(euler::c::gasShare));
}

template <int D>
void MixtureIce<D>::scheduleSources(TaskList& tasks) const {
  if (areBlended() && !burning_.empty()) scheduleClosing(tasks);  // a programmed burn reads volume fractions
  for (const Transfer& one : transfers_)
    tasks.acrossMaterials("ice::transferMass", transferMass<D>, gases_, with(one), startTime(), requiresOld(delT),
                          all<euler::ChangedGas>());
  for (const BurningGas& one : burning_)
    tasks.acrossMaterials("ice::burnByProgram", burnByProgram<D>, gases_, with(one), startTime(), requiresOld(delT),
                          withoutMaterial(modifies(euler::c::totalEnergy)), all<euler::ChangedGas>());
  for (const Reaction& one : reactions_)
    tasks.acrossMaterials("ice::reactGas", reactGas<D>, gases_, with(one), requiresOld(delT),
                          withoutMaterial(requiresNew(euler::c::density)),
                          withoutMaterial(requiresNew(euler::c::momentum<D>)),
                          withoutMaterial(modifies(euler::c::totalEnergy)), all<euler::ChangedGas>());
  if (diffusion_.acts())
    tasks.acrossMaterials("ice::addMixtureDiffusion", addMixtureDiffusion<D>, gases_, with(diffusion_),
                          withoutMaterial(all<euler::OldState<D>>(1)), all<euler::OldGas>(1), startTime(),
                          requiresOld(delT), withoutMaterial(modifies(euler::c::momentum<D>)),
                          withoutMaterial(modifies(euler::c::totalEnergy)),
                          withoutMaterial(all<euler::DiffusionRims<D>>()));
}

template <int D>
void MixtureIce<D>::scheduleHeat(TaskList& tasks) const {
  if ((heat_.act() && !areBlended()) || heating_.acts())
    tasks.acrossMaterials("ice::exchangeHeat", exchangeHeat<D>, gases_, with(heat_), with(heating_), startTime(),
                          requiresOld(delT), withoutMaterial(requiresNew(euler::c::density)),
                          withoutMaterial(requiresNew(euler::c::momentum<D>)),
                          withoutMaterial(modifies(euler::c::totalEnergy)), all<WarmGas>());
}

template <int D>
void MixtureIce<D>::scheduleAfterRefluxing(TaskList& tasks) const {
  if (!areBlended())
    tasks.acrossMaterials("ice::closeRefluxed", euler::closeRefluxed<D>, gases_, besideFiner(),
                          modifies(euler::c::gasShare));
  tasks.acrossMaterials("ice::checkRefluxed", euler::checkRefluxedMixture<D>, gases_, besideFiner(),
                        withoutMaterial(all<euler::ChangedState<D>>()), all<euler::ChangedGas>());
}

template <int D>
std::vector<std::shared_ptr<const data::JointInterpolation>> MixtureIce<D>::jointInterpolations() const {
  return {std::make_shared<const euler::MixtureInterpolation<D>>(gases_)};
}

template <int D>
void MixtureIce<D>::scheduleDiagnostics(TaskList& tasks) const {
  euler::scheduleTotals<D>(tasks);
  const auto state = withoutMaterial(all<euler::OldState<D>>(0));
  const auto each = all<euler::OldGas>(0);
  for (std::size_t k = 0; k < gases_.size(); ++k)
    tasks.acrossMaterials("ice::sumGas", sumGas<D>, gases_, with(k), each, computes(totals_[k]->label()));
  tasks.acrossMaterials("ice::computePressure", computeMixedPressure<D>, gases_, state, each,
                        withoutMaterial(computes(euler::c::pressure)));
  tasks.perPatch("euler::computeVelocity", euler::computeVelocity<D>, requiresOld(euler::c::density),
                 requiresOld(euler::c::momentum<D>), computes(euler::c::velocity<D>));
  tasks.acrossMaterials("ice::computeMach", computeMixedMach<D>, gases_, state, each,
                        withoutMaterial(computes(euler::c::mach<D>)));
  tasks.perPatch("euler::computeInternalEnergy", euler::computeInternalEnergy<D>, requiresOld(euler::c::density),
                 requiresOld(euler::c::momentum<D>), requiresOld(euler::c::totalEnergy),
                 computes(euler::c::internalEnergy));
  tasks.perPatch("ice::sumInternalEnergy", sumInternalEnergy<D>, requiresOld(euler::c::density),
                 requiresOld(euler::c::momentum<D>), requiresOld(euler::c::totalEnergy),
                 computes(total::internalEnergy));
  tasks.acrossMaterials("ice::computeTemperature", computeMixedTemperature<D>, gases_, state, each,
                        withoutMaterial(computes(c::temperature)));
  tasks.acrossMaterials("ice::computeSoundSpeed", computeMixedSoundSpeed<D>, gases_, state, each,
                        withoutMaterial(computes(c::soundSpeed)));
  if (isBinary_)
    tasks.acrossMaterials("ice::computeMassFraction", computeMassFraction<D>, gases_,
                          withoutMaterial(requiresOld(euler::c::density)), each,
                          withoutMaterial(computes(c::massFraction)));
  tasks.acrossMaterials("ice::computeOwnDensity", computeOwnDensity<D>, gases_, each, computes(c::ownDensity));
  tasks.perPatch("ice::computeSpecificVolume", computeSpecificVolume<D>, requiresOld(euler::c::density),
                 computes(c::specificVolume));
  if (tracers_) scheduleDiagnosticsOfTracers<D>(tasks, *tracers_, tracers_->ofGases());
}

template <int D>
std::vector<std::string> MixtureIce<D>::foreignLabels() const {
  std::vector<std::string> labels = uintahsLabels;
  if (isBinary_) labels.insert(labels.end(), {"scalar-f_src", "scalar-diffCoef", "sum_scalar-f"});
  return labels;
}

template <int D>
std::vector<std::string> MixtureIce<D>::gasNames() const {
  std::vector<std::string> names;
  for (const euler::Settings& gas : gases_) names.push_back(gas.name);
  if (isBinary_) names.push_back(binary_);
  return names;
}

template <int D>
simulation::OtherNames MixtureIce<D>::otherNames() const {
  simulation::OtherNames names{{"rho_CC", std::string(euler::c::gasMass.name)},
                               {"rho_micro_CC", std::string(c::ownDensity.name)},
                               {"vol_frac_CC", std::string(euler::c::gasShare.name)}};
  if (isBinary_)  // one gas to Uintah
    names = {{"scalar-f", std::string(c::massFraction.name)}, {"sum_scalar_f", "TotalMass-B"}};
  names.insert(names.end(), uintahsNames.begin(), uintahsNames.end());
  if (tracers_) tracers_->addNames(names);
  return names;
}

template <int D>
std::vector<reference::GasLaw> MixtureIce<D>::gases() const {
  if (areBlended())
    throw std::invalid_argument(
        "the exact solution is for ideal or stiffened gases, but a gas of the scene has another equation of state");
  std::vector<reference::GasLaw> laws;
  for (const euler::Settings& gas : gases_) laws.push_back({gas.gas.gamma, gas.gas.pInfinity});
  return laws;
}

template <int D>
void MixtureIce<D>::scheduleMeasureError(TaskList& tasks, const reference::GasReference& exact,
                                         const reference::Clock& clock) const {
  tasks.acrossMaterials("ice::measureError", measureMixedError<D>, gases_, with(&exact), with(&clock),
                        withoutMaterial(all<euler::OldState<D>>(0)), all<euler::OldGas>(0),
                        totals<reference::ErrorNorms>(&reference::cellError));
}

template class MixtureIce<1>;
template class MixtureIce<2>;
template class MixtureIce<3>;

}  // namespace tushar::ice
