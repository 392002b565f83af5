#include "components/mpmice/mpmice.hpp"

#include "components/ice/tasks/carry_scalar.hpp"
#include "components/ice/tracers/schedule.hpp"
#include "components/mpmice/burn/burn_modes.hpp"
#include "components/mpmice/burn/gas_of_burning.hpp"
#include "components/mpmice/burn/unsteady_surface.hpp"
#include "components/mpmice/tasks/add_diffusion.hpp"
#include "components/mpmice/tasks/add_gravity.hpp"
#include "components/mpmice/tasks/advance_gas.hpp"
#include "components/mpmice/tasks/advance_implicitly.hpp"
#include "components/mpmice/tasks/compute_stable_time_step.hpp"
#include "components/mpmice/tasks/conduct_to_bodies.hpp"
#include "components/mpmice/tasks/exchange_heat.hpp"
#include "components/mpmice/tasks/exchange_heat_at_faces.hpp"
#include "components/mpmice/tasks/find_flow.hpp"
#include "components/mpmice/tasks/heat_of_bodies.hpp"
#include "components/mpmice/tasks/initialize.hpp"
#include "components/mpmice/tasks/measure_motion.hpp"
#include "components/mpmice/tasks/react_gas.hpp"
#include "components/mpmice/tasks/refine_gas.hpp"
#include "components/mpmice/tasks/share_scalar.hpp"
#include "components/mpmice/tasks/share_small_cells.hpp"
#include "components/mpmice/uintah_words.hpp"

namespace tushar::mpmice {

namespace {

/// The function that advances the gas, for a method and a number of gases that share cells.
template <int D>
AdvanceGas<D> advanceBody(const euler::Method& method, std::size_t gases) {
  if (gases > 1) return chooseAdvanceGases<D>(method, gases);
  return method.reconstruction == euler::Reconstruction::firstOrder
             ? advanceGas<D, euler::Hllc, euler::Constant, 1>
             : advanceGas<D, euler::Hllc, euler::Sloped<VanLeer>, 1>;
}

/// Adds the task that finds the velocity with which tracers move; `reads` gives access to the masses of particles.
template <int D>
void scheduleFlow(TaskList& tasks, const std::vector<mpm::solid::Material>& materials, auto reads) {
  tasks.acrossMaterials("mpmice::findFlow", findFlowAround<D>, materials, withoutMaterial(all<FlowOfGas<D>>()),
                        all<MovingBody<D>>(reads));
}

}  // namespace

template <int D>
GasAround<D>::GasAround(Settings settings) : settings_(std::move(settings)) {
  for (const euler::Settings& gas : settings_.gases) totals_.push_back(std::make_shared<const ice::GasTotal>(gas.name));
  for (const ice::ScalarSettings& one : settings_.scalars)
    scalars_.push_back(std::make_shared<const ice::CarriedScalar>(one));
  tracers_ = ice::tracersOf(settings_.tracers, gasNames(), scalars_, true);
}

template <int D>
bool GasAround<D>::keepsStrain(const Materials& materials) const {
  return burns() && storesStrain(materials[settings_.burning->body]);
}

template <int D>
std::vector<std::string> GasAround<D>::gasNames() const {
  if (settings_.gases.empty()) return {settings_.gas.name};
  std::vector<std::string> names;
  for (const euler::Settings& gas : settings_.gases) names.push_back(gas.name);
  return names;
}

template <int D>
void GasAround<D>::scheduleStart(TaskList& tasks, const Materials& materials) const {
  tasks.perMaterial("mpmice::findBoxes", findBoxes<D>, materials, requiresNew(p::size<D>),
                    requiresNew(p::deformationMeasure), when(false, requiresNew(p::unburned)),
                    computes(p::boxEdges<D>));
  tasks.acrossMaterials("mpmice::measureFreeSpace", measureFreeSpace<D>, materials, all<Boxes<D>>(readsNew),
                        withoutMaterial(all<FreeShares<D>>(&c::freeVolume, settings_.endsAtPlane)));
  if (settings_.gases.empty())
    tasks.perPatch("mpmice::initialize", initialize<D>, with(settings_), requiresNew(c::freeVolume, 1),
                   computes(c::density), computes(c::momentum<D>), computes(c::totalEnergy));
  else
    tasks.perPatch("mpmice::initializeGases", initializeGases<D>, with(settings_), requiresNew(c::freeVolume, 1),
                   all<NewContent<D>>(settings_.gases.size()));
  for (const auto& one : scalars_) ice::scheduleStartOfScalar<D>(tasks, *one, c::density);
  if (settings_.diffusion.acts())
    tasks.perPatch("mpmice::measureDiffusivity", measureDiffusivity<D>, with(settings_), gasIn(readsNew, {}),
                   computes(total::diffusivityAtStart));
  if (settings_.implicit)
    tasks.perPatch("mpmice::guessPressure", guessPressure<D>, with(settings_), gasIn(readsNew, {}),
                   computes(c::pressureAtEnd));
  if (burns()) {
    tasks.perMaterial("mpmice::startUnburned", startUnburned, materials, requiresNew(p::mass), computes(p::unburned));
    tasks.perPatch("mpmice::startSum", startSum<D, double>, computes(c::burntSinceStart));
    if (isUnsteady())
      tasks.perMaterial("mpmice::startSurface", startSurface, materials, requiresNew(p::mass), all<NewSurface>());
    if (waitsForFlames())
      tasks.perPatch("mpmice::startBurnModes", startBurnModes<D>, computes(c::burnMode), computes(c::waited),
                     computes(c::inductionTime));
  }
  if (settings_.opensAtSides)
    tasks.perMaterial("mpmice::startAhead", startAhead<D>, materials, requiresNew(p::mass), computes(p::ahead<D>));
  tasks.perPatch("mpmice::startImpulse", startSum<D, Vec<D>>, computes(c::impulseSinceStart<D>));
  for (const CellLabel<double>* sum : {&c::workSinceStart, &c::heatSinceStart, &c::leakSinceStart})
    tasks.perPatch("mpmice::startSum", startSum<D, double>, computes(*sum));
  if (!tracers_) return;
  scheduleFlow<D>(tasks, materials, readsNew);
  ice::scheduleStartOfTracers<D>(tasks, *tracers_, settings_.gas.gas, tracersAfter(materials));
}

template <int D>
void GasAround<D>::scheduleForces(TaskList& tasks, const Materials& materials,
                                  const ParticleLabel<double>& state) const {
  if (materials.size() > 1)
    tasks.perMaterial("mpmice::measureBody", measureBody<D>, materials, all<Boxes<D>>(readsOld),
                      all<FreeOfBody<D>>(settings_.endsAtPlane));
  if (burns()) scheduleBurning(tasks, materials, state);
  if (settings_.implicit)
    schedulePressure(tasks, materials);
  else
    tasks.acrossMaterials("mpmice::computeWallPressure", computeWallPressure<D>, materials, with(settings_),
                          withoutMaterial(gasIn(readsOld, {.mass = 1, .room = 2})),
                          all<BodyAtFaces<D>>(1, materials.size() > 1, settings_.endsAtPlane),
                          withoutMaterial(all<Blowing<D>>(burns())), withoutMaterial(all<WallPressures<D>>()));
  if (hasFriction())
    tasks.acrossMaterials("mpmice::computeWallFriction", computeWallFriction<D>, materials, with(settings_),
                          requiresOld(delT), withoutMaterial(gasIn(readsOld, {.mass = 1, .room = 2})),
                          all<BodyAtFaces<D>>(1, materials.size() > 1, settings_.endsAtPlane),
                          withoutMaterial(computes(c::wallFriction<D>)));
  tasks.acrossMaterials("mpmice::addWallForce", addWallForce<D>, materials, with(settings_),
                        withoutMaterial(gasIn(readsOld, {.state = variesFriction() ? 2 : 0, .mass = 3, .room = 3})),
                        withoutMaterial(all<KnownWalls<D>>(2, hasFriction())),
                        all<BodyAtFaces<D>>(hasFriction() ? 3 : 2, materials.size() > 1, settings_.endsAtPlane),
                        computes(total::forceOnBodies), computes(g::surroundingForce<D>));
}

/// Adds the tasks for the pressure at the end of the step, including the pressure on walls.
template <int D>
void GasAround<D>::schedulePressure(TaskList& tasks, const Materials& materials) const {
  constexpr typename GasInCells<D>::Reach reach{.mass = 3, .room = 3};
  const auto gas = gasIn(readsOld, reach);
  tasks.perPatch("mpmice::takeGasAlone", takeGasAlone<D>, with(settings_), gas, all<NewGasAlone<D>>());
  tasks.acrossMaterials("mpmice::findWallSpeeds", findWallSpeeds<D>, materials, with(settings_), withoutMaterial(gas),
                        all<BodyAtFaces<D>>(1, materials.size() > 1, settings_.endsAtPlane),
                        withoutMaterial(all<NewWallSpeeds<D>>()));
  tasks.perRank("mpmice::solvePressure", solvePressureBeside<D>, withWorkers(), with(settings_), startTime(),
                requiresOld(delT), all<GasAtWalls<D>>(), gas, requiresOld(c::pressureAtEnd), all<ice::PressureViews>(),
                totals<ice::SolveTotals>());
  tasks.acrossMaterials("mpmice::takeWallPressure", takeWallPressure<D>, materials, with(settings_),
                        withoutMaterial(gas), all<BodyAtFaces<D>>(1, materials.size() > 1, settings_.endsAtPlane),
                        withoutMaterial(requiresNew(c::pressureAtEnd)), withoutMaterial(all<WallPressures<D>>()));
}

/// Adds the tasks for the volume that bodies fill at the end of the step, and the volume that they swept.
template <int D>
void GasAround<D>::scheduleBoxes(TaskList& tasks, const Materials& materials) const {
  if (burns())
    tasks.perMaterial("mpmice::burnParticles", burnParticles<D>, materials, with(settings_),
                      withoutMaterial(requiresNew(c::burntShare)), requiresOld(p::mass), requiresOld(p::unburned),
                      computes(p::mass), computes(p::unburned));
  tasks.perMaterial("mpmice::findBoxes", findBoxes<D>, materials, requiresOld(p::size<D>),
                    requiresNew(p::deformationMeasure), when(burns(), requiresNew(p::unburned)),
                    computes(p::boxEdges<D>));
  if (settings_.opensAtSides)
    tasks.perMaterial("mpmice::findFollowers", findFollowers<D>, materials, with(settings_), all<Boxes<D>>(readsNew),
                      requiresOld(p::ahead<D>), computes(p::ahead<D>));
  tasks.acrossMaterials("mpmice::measureMotion", measureMotion<D>, materials, with(settings_),
                        withoutMaterial(all<GasNearby>()), all<MovedBoxes<D>>(settings_.opensAtSides),
                        withoutMaterial(all<FreeShares<D>>(&c::unfilledVolume, settings_.endsAtPlane)),
                        withoutMaterial(all<SweptFaces<D>>()),
                        withoutMaterial(when(settings_.opensAtSides, computes(c::leaving<D>))));
}

template <int D>
void GasAround<D>::scheduleMotion(TaskList& tasks, const Materials& materials) const {
  scheduleBoxes(tasks, materials);
  const bool keepsMasses = !scalars_.empty();
  if (settings_.implicit)
    tasks.acrossMaterials("mpmice::advanceImplicitly", advanceImplicitly<D>, materials, with(settings_), startTime(),
                          requiresOld(delT), withoutMaterial(all<GasInStep<D>>(settings_.endsAtPlane)),
                          withoutMaterial(all<BodiesInStep<D>>(hasFriction(), settings_.opensAtSides)),
                          all<BodyAtFaces<D>>(2, materials.size() > 1, settings_.endsAtPlane),
                          withoutMaterial(all<OutcomeOfStep<D>>(settings_.gases.size(), keepsMasses)),
                          computes(total::powerOnBodies));
  else
    tasks.acrossMaterials(
        "mpmice::advanceGas", advanceBody<D>(settings_.gas.method, settings_.gases.size()), materials, with(settings_),
        startTime(), requiresOld(delT), withoutMaterial(gasIn(readsOld, {.state = 2, .mass = 2, .room = 3})),
        withoutMaterial(all<BodiesInStep<D>>(hasFriction(), settings_.opensAtSides)),
        all<BodyAtFaces<D>>(2, materials.size() > 1, settings_.endsAtPlane),
        withoutMaterial(all<OutcomeOfStep<D>>(settings_.gases.size(), keepsMasses)), computes(total::powerOnBodies));
  carryScalars(tasks);
  if (settings_.diffusion.acts())
    tasks.perPatch("mpmice::addDiffusion", settings_.diffusion.varies() ? addVaryingDiffusion<D> : addDiffusion<D>,
                   with(settings_), gasIn(readsOld, {.state = 1, .mass = 3, .room = 3}), startTime(), requiresOld(delT),
                   requiresOld(total::diffusivityAtStart), modifies(c::unsharedMomentum<D>),
                   modifies(c::unsharedEnergy), all<RimsOfDiffusion<D>>());
  if (conductsToBodies()) scheduleConduction(tasks, materials);
  if (burns())
    tasks.acrossMaterials("mpmice::addBurntGas", addBurntGas<D>, materials, with(settings_),
                          all<BurningParticles<D>>(keepsStrain(materials)),
                          withoutMaterial(all<BurntGas<D>>(settings_.gases.size())));
  tasks.perPatch("mpmice::shareSmallCells", shareSmallCells<D>, with(settings_),
                 all<Unshared<D>>(settings_.gases.size()), all<NewGas<D>>(settings_.gases.size()),
                 totals<SmallCellTotals>());
  shareScalars(tasks);
  const auto reacting = all<ReactingGas<D>>(settings_.gases.size());
  if (!settings_.reactions.empty())
    tasks.perPatch("mpmice::reactGases", reactGases<D>, with(settings_), requiresOld(delT), reacting);
  scheduleHeat(tasks, materials);
  if (!settings_.gravity.isZero(0) && !settings_.implicit)
    tasks.perPatch("mpmice::addGravity", addGravity<D>, with(settings_.gravity), requiresNew(c::freeVolume),
                   requiresNew(c::density), requiresOld(delT), modifies(c::momentum<D>), modifies(c::totalEnergy));
  if (areBlended(settings_)) tasks.perPatch("mpmice::closeGases", closeGases<D>, with(settings_), reacting);
  scheduleSums(tasks, materials);
  if (burns())
    tasks.perMaterial("mpmice::removeBurnt", removeBurnt<D>, materials, requiresOld(p::mass), requiresNew(p::mass),
                      modifies(p::x<D>), when(keepsStrain(materials), modifies(p::strainEnergy)));
  if (!tracers_) return;
  scheduleFlow<D>(tasks, materials, readsOld);
  ice::scheduleMotionOfTracers<D>(tasks, *tracers_, settings_.gas.gas, tracersAfter(materials));
}

template <int D>
void GasAround<D>::scheduleRelocation(TaskList& tasks, const Materials& materials) const {
  if (tracers_)
    tasks.relocate(p::x<D>, tracersAfter(materials));
  else
    tasks.relocate(p::x<D>, materials);
}

template <int D>
void GasAround<D>::scheduleNewTracers(TaskList& tasks, const Materials& materials) const {
  if (tracers_) ice::scheduleNewTracers<D>(tasks, *tracers_, settings_.gas.gas, tracersAfter(materials));
}

template <int D>
void GasAround<D>::carryScalars(TaskList& tasks) const {
  const bool hasSlopes = settings_.gas.method.reconstruction != euler::Reconstruction::firstOrder;
  for (const auto& one : scalars_)
    tasks.perPatch(
        "ice::carryScalar", ice::carryScalar<D>, with(one.get()), with(settings_.gas.gas), with(hasSlopes),
        all<ice::ScalarBefore<D>>(one.get(), ice::RoomOfGas{&c::freeVolume, wholeFreeVolume, leastFreeVolume}),
        startTime(), requiresOld(delT), computes(one->unshared()), keepsFlux(one->unshared()));
}

template <int D>
void GasAround<D>::shareScalars(TaskList& tasks) const {
  for (const auto& one : scalars_) {
    tasks.perPatch("mpmice::shareScalar", shareScalar<D>, with(settings_), all<Unshared<D>>(std::size_t{0}),
                   requiresNew(one->unshared(), 2), requiresNew(c::density), computes(one->held()));
    ice::scheduleChangesOfScalar<D>(tasks, *one, c::density);
  }
}

/// Adds the tasks for heat exchange by coefficients between bodies and gases, of which there are at most `Most`.
template <int D>
template <int Most>
void GasAround<D>::scheduleExchange(TaskList& tasks, const Materials& materials) const {
  const std::size_t gases = settings_.gases.size();
  tasks.perMaterial("mpmice::measureHeatOfBody", measureHeatOfBody<D>, materials, all<WarmParticles<D>>(burns()),
                    all<NewWarmBody>());
  tasks.acrossMaterials("mpmice::exchangeHeatAtFaces", exchangeHeatAtFaces<D, Most>, materials, with(settings_),
                        requiresOld(delT),
                        withoutMaterial(all<WarmGas<D, const double>>(gases, 1, settings_.convection ? 2 : 1)),
                        all<WarmBody>(1), all<HeatOfBodyAtFaces>(), withoutMaterial(all<HeatOfGasAtFaces>(gases)));
  tasks.acrossMaterials("mpmice::exchangeHeat", exchangeHeat<D, Most>, materials, with(settings_), startTime(),
                        requiresOld(delT), withoutMaterial(all<WarmGas<D>>(gases)),
                        withoutMaterial(all<GasAtFaces>(gases)), all<WarmingBody>(), withoutMaterial(offers(c::heat)));
  tasks.perMaterial("mpmice::warmBody", warmBody<D>, materials, requiresNew(p::x<D>), requiresNew(p::boxEdges<D>),
                    requiresNew(c::warming, boxReach), modifies(p::temperature));
}

/// Adds the tasks for heat exchange by coefficients, and for heat from outside.
template <int D>
void GasAround<D>::scheduleHeat(TaskList& tasks, const Materials& materials) const {
  const std::size_t gases = settings_.gases.size();
  if (hasHeat() && materials.size() + std::max<std::size_t>(1, gases) <= kFewThings)
    scheduleExchange<kFewThings>(tasks, materials);
  else if (hasHeat())
    scheduleExchange<Eigen::Dynamic>(tasks, materials);
  else if (settings_.heating.acts() && gases > 0)
    tasks.perPatch("mpmice::heatGases", heatGases<D>, with(settings_), startTime(), requiresOld(delT),
                   all<WarmGas<D>>(gases));
  else if (settings_.heating.acts())
    tasks.perPatch("mpmice::heatGas", ice::addHeat<D>, with(settings_.heating), requiresNew(c::density), startTime(),
                   requiresOld(delT), modifies(c::totalEnergy));
}

/// Adds the tasks for the heat that walls of bodies conduct, given the state at the start of the step.
template <int D>
void GasAround<D>::scheduleConduction(TaskList& tasks, const Materials& materials) const {
  constexpr typename GasInCells<D>::Reach reach{.state = 1, .mass = 2, .room = 2};
  tasks.acrossMaterials("mpmice::measureBodyHeat", measureBodyHeat<D>, materials, with(settings_),
                        withoutMaterial(all<GasNearby>()), all<HeatOfParticles<D>>(), withoutMaterial(all<BodyHeat>()));
  tasks.perPatch("mpmice::conductFromGas", conductFromGas<D>, with(settings_), gasIn(readsOld, reach),
                 all<KnownBodyHeat>(), requiresOld(delT), modifies(c::unsharedEnergy), all<WallHeats>());
  tasks.acrossMaterials("mpmice::conductToBodies", conductToBodies<D>, materials, with(settings_), all<OldBoxes<D>>(),
                        withoutMaterial(requiresNew(c::wallWarming, reachAtStart)), modifies(p::temperature));
}

template <int D>
void GasAround<D>::scheduleStableTimeStep(TaskList& tasks, const Materials& materials) const {
  if (settings_.areRigid)
    tasks.perMaterial("mpmice::limitStepOfRigidBodies", limitStepOfRigidBodies<D>, materials,
                      with(settings_.gas.courant.number), requiresOld(p::velocity<D>), computes(delT));
  else
    tasks.perPatch("mpmice::limitStepOfBodies", limitStepOfBodies, with(settings_.gas.courant.number),
                   requiresOld(mpm::solid::total::stableTimeStep), computes(delT));
  if (settings_.implicit) {
    const auto gas = gasIn(readsOld, {.state = 1, .mass = 2, .room = 2});
    const char* name = "mpmice::limitImplicitStep";
    if (settings_.diffusion.varies())
      tasks.perPatch(name, limitVaryingImplicitStep<D>, with(settings_), gas, startTime(),
                     requiresOld(total::diffusivityAtStart), computes(delT));
    else if (settings_.implicit->diffusion.acts())
      tasks.perPatch(name, limitImplicitStep<D>, with(settings_), gas, requiresOld(total::diffusivityAtStart),
                     computes(delT));
    else
      tasks.perPatch(name, limitImplicitStep<D>, with(settings_), gas, with(0.0), computes(delT));
    return;
  }
  tasks.perPatch("mpmice::computeStableTimeStep",
                 settings_.gases.empty() ? computeStableTimeStep<D> : limitStepOfGases<D>, with(settings_),
                 gasIn(readsOld, {}), computes(delT));
  if (!settings_.areRigid)
    tasks.acrossMaterials("mpmice::limitStepOfLightBodies", limitStepOfLightBodies<D>, materials, with(settings_),
                          withoutMaterial(gasIn(readsOld, {.room = 1})), computes(delT));
  if (settings_.diffusion.acts() && !settings_.diffusion.varies())
    tasks.perPatch("mpmice::limitDiffusion", limitDiffusion<D>, with(settings_), gasIn(readsOld, {}),
                   requiresOld(total::diffusivityAtStart), computes(delT));
  if (settings_.diffusion.acts() && settings_.diffusion.varies())
    tasks.perPatch("mpmice::limitDiffusion", limitVaryingDiffusion<D>, with(settings_),
                   gasIn(readsOld, {.state = 1, .mass = 1, .room = 1}), startTime(),
                   requiresOld(total::diffusivityAtStart), computes(delT));
}

template <int D>
void GasAround<D>::scheduleErrorEstimate(TaskList& tasks) const {
  tasks.perPatch("mpmice::markBodies", markBodies<D>, requiresOld(c::freeVolume, markedLayers), marks());
}

template <int D>
void GasAround<D>::scheduleRefine(TaskList& tasks) const {
  if (settings_.gases.empty())
    tasks.perPatch("euler::mendNewCells", euler::mendNewCells<D>, with(settings_.gas.gas), newCells(),
                   all<euler::ChangedState<D>>());
  else
    tasks.perPatch("mpmice::mendNewGases", mendNewGases<D>, with(settings_.gases), newCells(),
                   all<euler::ChangedState<D>>(), all<ChangedGases>(settings_.gases.size()));
}

template <int D>
std::string MpmIce<D>::advice() const {
  const std::string common = "a smaller CFD/cfl, or more particles per cell along surfaces (res)";
  if (!gas_->areBodiesRigid()) return common;
  return common + "; bodies of rmpmice do not stop at sides of the grid: end the run before they arrive";
}

template <int D>
std::vector<std::string> MpmIce<D>::foreignLabels() const {
  std::vector<std::string> labels = solids_->foreignLabels();
  labels.insert(labels.end(), ice::uintahsLabels.begin(), ice::uintahsLabels.end());
  labels.insert(labels.end(), uintahsLabels.begin(), uintahsLabels.end());
  for (const auto& one : gas_->scalars()) one->addForeignLabels(labels);
  if (gas_->tracers()) labels.emplace_back("nPPC");
  return labels;
}

template <int D>
simulation::OtherNames MpmIce<D>::otherNames() const {
  simulation::OtherNames names = uintahsNames;
  const simulation::OtherNames ofSolids = solids_->otherNames();
  names.insert(names.end(), ice::uintahsNames.begin(), ice::uintahsNames.end());
  names.insert(names.end(), ofSolids.begin(), ofSolids.end());
  for (const auto& one : gas_->scalars()) one->addNames(names);
  if (gas_->tracers()) gas_->tracers()->addNames(names);
  return names;
}

template class MpmIce<1>;
template class MpmIce<2>;
template class MpmIce<3>;
template class GasAround<1>;
template class GasAround<2>;
template class GasAround<3>;

}  // namespace tushar::mpmice
