#include "components/ice/ice.hpp"

#include "components/euler/tasks/add_diffusion.hpp"
#include "components/euler/tasks/add_gravity.hpp"
#include "components/ice/diagnose.hpp"
#include "components/ice/uintah_words.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::ice {

template <int D>
void Ice<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  euler::Euler<D>::scheduleComputeStableTimeStep(tasks);
  if (diffusion_.acts())
    tasks.perPatch("euler::limitDiffusion", euler::limitDiffusion<D>, with(gas_), with(diffusion_), with(cfl_),
                   requiresOld(euler::c::density), requiresOld(euler::c::momentum<D>),
                   requiresOld(euler::c::totalEnergy), computes(delT));
}

template <int D>
void Ice<D>::scheduleTimeAdvance(TaskList& tasks) const {
  euler::Euler<D>::scheduleTimeAdvance(tasks);
  if (diffusion_.acts())
    tasks.perPatch("euler::addDiffusion", euler::addDiffusion<D>, with(gas_), with(diffusion_),
                   requiresOld(euler::c::density, 1), requiresOld(euler::c::momentum<D>, 1),
                   requiresOld(euler::c::totalEnergy, 1), requiresOld(delT), modifies(euler::c::momentum<D>),
                   modifies(euler::c::totalEnergy), all<euler::DiffusionRims<D>>());
  if (!gravity_.isZero(0))
    tasks.perPatch("euler::addGravity", euler::addGravity<D>, with(gravity_), requiresNew(euler::c::density),
                   requiresOld(delT), modifies(euler::c::momentum<D>), modifies(euler::c::totalEnergy));
}

template <int D>
void Ice<D>::scheduleDiagnostics(TaskList& tasks) const {
  euler::Euler<D>::scheduleDiagnostics(tasks);
  tasks.perPatch("ice::sumInternalEnergy", sumInternalEnergy<D>, requiresOld(euler::c::density),
                 requiresOld(euler::c::momentum<D>), requiresOld(euler::c::totalEnergy),
                 computes(total::internalEnergy));
  tasks.perPatch("ice::computeTemperature", computeTemperature<D>, with(gas_), requiresOld(euler::c::density),
                 requiresOld(euler::c::momentum<D>), requiresOld(euler::c::totalEnergy), computes(c::temperature));
  tasks.perPatch("ice::computeSoundSpeed", computeSoundSpeed<D>, with(gas_), requiresOld(euler::c::density),
                 requiresOld(euler::c::momentum<D>), requiresOld(euler::c::totalEnergy), computes(c::soundSpeed));
  tasks.perPatch("ice::computeSpecificVolume", computeSpecificVolume<D>, requiresOld(euler::c::density),
                 computes(c::specificVolume));
}

template <int D>
std::vector<std::string> Ice<D>::foreignLabels() const {
  return uintahsLabels;
}

template <int D>
std::vector<std::pair<std::string, std::string>> Ice<D>::otherNames() const {
  return uintahsNames;
}

template class Ice<1>;
template class Ice<2>;
template class Ice<3>;

simulation::ComponentKind kind() {
  simulation::ComponentKind kind;
  kind.name = "ice";
  kind.sentence = "a compressible gas in the words of Uintah's ICE, by the method of euler";
  kind.sections = gasSections();
  kind.takesLevels = true;
  kind.amrSections = {"ICE"};
  kind.boundaryLabels = gasBoundaryLabels();
  kind.describe = describeGas;
  kind.forms = [] { return std::vector<std::vector<simulation::SectionForm>>{gasForms()}; };
  kind.read = [](const input::Element& root, input::Diagnostics& diagnostics) -> simulation::MakeComponent {
    const std::size_t before = diagnostics.size();
    const GasScene scene = readGas(root, 0, diagnostics);
    const auto properties = root.child("MaterialProperties");
    if (const auto solids = properties ? properties->child("MPM") : std::nullopt)
      diagnostics.error(*solids, "'ice' has no solids: keep the gas alone");
    if (scene.thinWalls) diagnostics.note(scene.where, thinWallsPath, "does nothing: there are no bodies");
    if (scene.exchange) diagnostics.note(scene.exchange->where, exchangePath, "does nothing: there is one material");
    if (diagnostics.size() > before) return {};
    return [scene](const Level& level) { return simulation::makeByDimension<Ice>(level, scene); };
  };
  return kind;
}

}  // namespace tushar::ice
