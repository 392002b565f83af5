#include "components/ice/ice.hpp"

#include "components/euler/tasks/add_diffusion.hpp"
#include "components/euler/tasks/add_gravity.hpp"
#include "components/euler/tasks/add_varying_diffusion.hpp"
#include "components/ice/diagnose.hpp"
#include "components/ice/mixture/mixture_ice.hpp"
#include "components/ice/tasks/advance_implicitly.hpp"
#include "components/ice/tasks/carry_scalar.hpp"
#include "components/ice/tasks/limit_implicit_step.hpp"
#include "components/ice/tasks/solve_pressure.hpp"
#include "components/ice/tracers/schedule.hpp"
#include "components/ice/uintah_words.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::ice {

template <int D>
void Ice<D>::scheduleDiffusion(TaskList& tasks) const {
  const auto schedule = [&](auto body, const auto& how) {
    tasks.perPatch("euler::addDiffusion", body, with(this->settings().gas), with(how), all<euler::OldState<D>>(1),
                   startTime(), requiresOld(delT), modifies(euler::c::momentum<D>), modifies(euler::c::totalEnergy),
                   all<euler::DiffusionRims<D>>());
  };
  if (varying_.varies())
    schedule(euler::addVaryingDiffusion<D>, varying_);
  else if (acting_.diffusion.acts())
    schedule(euler::addDiffusion<D>, acting_.diffusion);
  if (heating_.acts())
    tasks.perPatch("ice::addHeat", addHeat<D>, with(heating_), requiresNew(euler::c::density), startTime(),
                   requiresOld(delT), modifies(euler::c::totalEnergy));
}

template <int D>
void Ice<D>::scheduleStepsOfDiffusion(TaskList& tasks) const {
  if (!varying_.varies()) return;
  tasks.perPatch("euler::limitDiffusion", euler::limitVaryingDiffusion<D>, with(this->settings().gas), with(varying_),
                 with(this->settings().courant.number), all<euler::OldState<D>>(1), startTime(), computes(delT));
}

template <int D>
void Ice<D>::scheduleInitialize(TaskList& tasks) const {
  euler::Euler<D>::scheduleInitialize(tasks);
  for (const auto& one : scalars_) scheduleStartOfScalar<D>(tasks, *one, euler::c::density);
  scheduleStartAlone<D>(tasks, tracers_.get(), this->settings().gas);
}

template <int D>
void Ice<D>::scheduleTracers(TaskList& tasks) const {
  scheduleStepAlone<D>(tasks, tracers_.get(), this->settings().gas);
}

template <int D>
std::vector<simulation::Reported> Ice<D>::reported() const {
  if (!tracers_) return {};
  return {numberOfTracers()};
}

template <int D>
void Ice<D>::scheduleScalars(TaskList& tasks) const {
  const bool hasSlopes = this->settings().method.reconstruction != euler::Reconstruction::firstOrder;
  for (const auto& one : scalars_) {
    tasks.perPatch("ice::carryScalar", carryScalar<D>, with(one.get()), with(this->settings().gas), with(hasSlopes),
                   all<ScalarBefore<D>>(one.get()), startTime(), requiresOld(delT), computes(one->held()),
                   keepsFlux(one->held()));
    scheduleChangesOfScalar<D>(tasks, *one, euler::c::density);
  }
}

template <int D>
void Ice<D>::scheduleStepsOfScalars(TaskList& tasks) const {
  for (const auto& one : scalars_)
    if (one->settings().diffusivity > 0)
      tasks.perPatch("ice::limitScalarDiffusion", limitScalarDiffusion<D>, with(one->settings().diffusivity),
                     with(this->settings().courant.number), requiresOld(euler::c::density), computes(delT));
}

template <int D>
void Ice<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  euler::Euler<D>::scheduleComputeStableTimeStep(tasks);
  scheduleStepsOfScalars(tasks);
  scheduleStepsOfDiffusion(tasks);
  if (acting_.diffusion.acts())
    tasks.perPatch("euler::limitDiffusion", euler::limitDiffusion<D>, with(this->settings().gas),
                   with(acting_.diffusion), with(this->settings().courant.number), requiresOld(euler::c::density),
                   requiresOld(euler::c::momentum<D>), requiresOld(euler::c::totalEnergy), computes(delT));
}

template <int D>
void Ice<D>::scheduleTimeAdvance(TaskList& tasks) const {
  euler::Euler<D>::scheduleTimeAdvance(tasks);
  scheduleScalars(tasks);
  scheduleDiffusion(tasks);
  if (!acting_.push.isZero(0))
    tasks.perPatch("euler::addForce", euler::addForce<D>, with(acting_.push), requiresNew(euler::c::density),
                   requiresOld(delT), modifies(euler::c::momentum<D>), modifies(euler::c::totalEnergy));
  if (!acting_.gravity.isZero(0))
    tasks.perPatch("euler::addGravity", euler::addGravity<D>, with(acting_.gravity), requiresNew(euler::c::density),
                   requiresOld(delT), modifies(euler::c::momentum<D>), modifies(euler::c::totalEnergy));
  scheduleTracers(tasks);
}

template <int D>
void Ice<D>::scheduleDiagnostics(TaskList& tasks) const {
  euler::Euler<D>::scheduleDiagnostics(tasks);
  tasks.perPatch("ice::sumInternalEnergy", sumInternalEnergy<D>, requiresOld(euler::c::density),
                 requiresOld(euler::c::momentum<D>), requiresOld(euler::c::totalEnergy),
                 computes(total::internalEnergy));
  tasks.perPatch("ice::computeTemperature", computeTemperature<D>, with(this->settings().gas),
                 requiresOld(euler::c::density), requiresOld(euler::c::momentum<D>), requiresOld(euler::c::totalEnergy),
                 computes(c::temperature));
  tasks.perPatch("ice::computeSoundSpeed", computeSoundSpeed<D>, with(this->settings().gas),
                 requiresOld(euler::c::density), requiresOld(euler::c::momentum<D>), requiresOld(euler::c::totalEnergy),
                 computes(c::soundSpeed));
  for (const auto& one : scalars_) {
    tasks.perPatch("ice::computeScalar", computeScalar<D>, requiresOld(euler::c::density), requiresOld(one->held()),
                   computes(one->value()));
    tasks.perPatch("ice::sumScalar", sumScalar<D>, requiresOld(one->held()), computes(one->total()));
  }
  tasks.perPatch("ice::computeSpecificVolume", computeSpecificVolume<D>, requiresOld(euler::c::density),
                 computes(c::specificVolume));
  if (tracers_) scheduleDiagnosticsOfTracers<D>(tasks, *tracers_, tracers_->ofGases());
}

template <int D>
std::vector<std::string> Ice<D>::foreignLabels() const {
  auto labels = uintahsLabels;
  if (tracers_) labels.emplace_back("nPPC");
  for (const auto& one : scalars_) one->addForeignLabels(labels);
  return labels;
}

template <int D>
simulation::OtherNames Ice<D>::otherNames() const {
  simulation::OtherNames names = uintahsNames;
  for (const auto& one : scalars_) one->addNames(names);
  if (tracers_) tracers_->addNames(names);
  return names;
}

template <int D>
void ImplicitIce<D>::scheduleInitialize(TaskList& tasks) const {
  Ice<D>::scheduleInitialize(tasks);
  tasks.perPatch("ice::initializePressure", initializePressure<D>, with(this->settings().gas),
                 requiresNew(euler::c::density), requiresNew(euler::c::momentum<D>), requiresNew(euler::c::totalEnergy),
                 computes(c::pressureAtEnd));
}

template <int D>
void ImplicitIce<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  if (this->varying().varies())
    tasks.perPatch("ice::limitImplicitStep", limitVaryingImplicitStep<D>, with(this->settings()), with(this->acting()),
                   with(this->varying()), all<euler::OldState<D>>(2), startTime(), requiresOld(c::pressureAtEnd, 2),
                   computes(delT));
  else
    tasks.perPatch("ice::limitImplicitStep", limitImplicitStep<D>, with(this->settings()), with(this->acting()),
                   all<euler::OldState<D>>(2), startTime(), requiresOld(c::pressureAtEnd, 2), computes(delT));
  this->scheduleStepsOfScalars(tasks);
}

template <int D>
void ImplicitIce<D>::scheduleTimeAdvance(TaskList& tasks) const {
  tasks.perRank("ice::solvePressure", solvePressure<D>, withWorkers(), with(this->settings()), with(this->acting()),
                startTime(), requiresOld(delT), all<euler::OldState<D>>(2), requiresOld(c::pressureAtEnd),
                all<PressureViews>(), totals<SolveTotals>());
  tasks.perPatch("ice::advanceImplicitly", advanceImplicitly<D>, with(this->settings()), with(this->acting()),
                 all<euler::OldState<D>>(2), startTime(), requiresOld(delT), requiresNew(c::pressureChange, 2),
                 all<euler::NewState<D>>(), all<euler::FaceMasses<D>>(this->keepsFaceMasses()));
  this->scheduleScalars(tasks);
  this->scheduleDiffusion(tasks);
  this->scheduleTracers(tasks);
}

template class ImplicitIce<1>;
template class ImplicitIce<2>;
template class ImplicitIce<3>;
template class Ice<1>;
template class Ice<2>;
template class Ice<3>;

namespace {

/// The smallest number of cells along an axis of a block; the tasks for several gases need more ghosts than those for
/// one.
int cellsOfBlocks(const input::Element& root) {
  const auto properties = root.child("MaterialProperties");
  const auto gases = properties ? properties->child("ICE") : std::nullopt;
  const auto models = root.child("Models");
  const auto list = models ? models->children("Model") : std::vector<input::Element>();
  const bool isBinary = std::any_of(list.begin(), list.end(), [](const input::Element& model) {
    return model.attribute("type") == "BinaryProperties";
  });
  return isBinary || (gases && gases->children("material").size() > 1) ? 6 : 4;
}

std::unique_ptr<Component> makeComponent(const Level& level, const GasScene& scene) {
  if (!scene.mixture.empty() && scene.implicit) return simulation::makeByDimension<ImplicitMixtureIce>(level, scene);
  if (!scene.mixture.empty()) return simulation::makeByDimension<MixtureIce>(level, scene);
  return scene.implicit ? simulation::makeByDimension<ImplicitIce>(level, scene)
                        : simulation::makeByDimension<Ice>(level, scene);
}

}  // namespace

simulation::ComponentKind kind() {
  simulation::ComponentKind kind;
  kind.name = "ice";
  kind.sentence = "a compressible gas with the input of Uintah's ICE and the method of euler";
  kind.sections = gasSections();
  kind.takesLevels = true;
  kind.takesPartsOfSides = true;
  kind.takesFormulasAtSides = true;
  kind.amrSections = {"ICE"};
  kind.cellsOfBlocks = cellsOfBlocks;
  kind.boundaryLabels = gasBoundaryLabels();
  kind.conditionWords = gasConditionWords();
  kind.describe = describeGas;
  kind.forms = [] { return std::vector<std::vector<simulation::SectionForm>>{gasForms()}; };
  kind.read = [](const input::Element& root, input::Diagnostics& diagnostics) -> simulation::MakeComponent {
    const std::size_t before = diagnostics.size();
    const GasScene scene = readGas(root, 0, diagnostics);
    const auto properties = root.child("MaterialProperties");
    if (const auto solids = properties ? properties->child("MPM") : std::nullopt)
      diagnostics.error(*solids, "'ice' has no solids: keep only the gas");
    if (scene.thinWalls) diagnostics.note(scene.where, thinWallsPath, "does nothing: there are no bodies");
    if (scene.exchange && scene.mixture.empty())
      diagnostics.note(scene.exchange->where, exchangePath, "does nothing: there is one material");
    if (diagnostics.size() > before) return {};
    return [scene, check = checkOfAxes(root, scene)](const Level& level) {
      check(level);
      return makeComponent(level, scene);
    };
  };
  return kind;
}

}  // namespace tushar::ice
