#include "components/ice/tracers/schedule.hpp"
#include "components/mpmice/burn/gas_of_burning.hpp"
#include "components/mpmice/mpmice.hpp"
#include "components/mpmice/tasks/diagnose.hpp"
#include "components/mpmice/tasks/measure_exchange.hpp"

namespace tushar::mpmice {

/// Adds the tasks for sums over a step and since its start: of the exchange with bodies, and of the leak through them.
/// Sums since the start are computed only if something needs them.
template <int D>
void GasAround<D>::scheduleSums(TaskList& tasks, const Materials& materials) const {
  tasks.perPatch("mpmice::addImpulse", addToSum<D, Vec<D>>, requiresNew(c::impulse<D>),
                 requiresOld(c::impulseSinceStart<D>), computes(c::impulseSinceStart<D>));
  tasks.perPatch("mpmice::addWork", addToSum<D, double>, requiresNew(c::work), requiresOld(c::workSinceStart),
                 computes(c::workSinceStart));
  if (hasHeat()) {
    tasks.perPatch("mpmice::addHeat", addHeatToSum<D>, requiresNew(c::heat),
                   when(conductsToBodies(), requiresNew(c::wallHeat)), requiresOld(c::heatSinceStart),
                   computes(c::heatSinceStart));
    tasks.perPatch("mpmice::sumHeatOfStep", sumHeatOfStep<D>, requiresNew(c::heat),
                   when(conductsToBodies(), requiresNew(c::wallHeat)), computes(total::heatOfStep));
  }
  tasks.acrossMaterials("mpmice::measureLeak", measureLeak<D>, materials, all<Boxes<D>>(readsOld), with(settings_),
                        withoutMaterial(gasIn(readsOld, {.mass = 1, .room = 1})),
                        withoutMaterial(requiresNew(c::massFlow<D>, 1)),
                        withoutMaterial(requiresOld(c::leakSinceStart)), withoutMaterial(computes(c::leakSinceStart)));
}

/// Adds the tasks for the energy of gas and bodies.
template <int D>
void GasAround<D>::scheduleEnergy(TaskList& tasks, const Materials& materials) const {
  tasks.perPatch("mpmice::sumEnergyOfGas", euler::sumEnergy<D>, requiresOld(c::totalEnergy), computes(total::energy));
  tasks.perMaterial("mpmice::sumEnergyOfBody", sumEnergyOfBody<D>, materials, requiresOld(p::mass),
                    requiresOld(p::velocity<D>), requiresOld(p::deformationMeasure),
                    when(exchangesHeat(), requiresOld(p::temperature)), computes(total::energy));
  if (burns())
    tasks.perPatch("mpmice::subtractReactionHeat", subtractReactionHeat<D>, with(settings_),
                   requiresOld(c::burntSinceStart), computes(total::energy));
}

template <int D>
void GasAround<D>::scheduleDiagnostics(TaskList& tasks, const Materials& materials) const {
  const auto gas = gasIn(readsOld, {});
  tasks.perPatch("mpmice::computePressure", computePressure<D>, with(settings_), gas, computes(c::pressure));
  tasks.perPatch("mpmice::computeVelocity", computeVelocity<D>, gas, computes(c::velocity<D>));
  tasks.perPatch("mpmice::computeMach", computeMach<D>, with(settings_), gas, computes(c::mach<D>));
  tasks.perPatch("mpmice::computeGasDensity", computeGasDensity<D>, gas, computes(c::gasDensity));
  tasks.perPatch("mpmice::computeTemperature", computeTemperature<D>, with(settings_), gas, computes(c::temperature));
  for (std::size_t k = 0; k < totals_.size(); ++k)
    tasks.perPatch("mpmice::sumGas", euler::sumMass<D>, requiresOld(c::massOfGas[k]), computes(totals_[k]->label()));
  tasks.perPatch("mpmice::computeSoundSpeed", computeSoundSpeed<D>, with(settings_), gas, computes(c::soundSpeed));
  tasks.perPatch("mpmice::computeSpecificVolume", computeSpecificVolume<D>, gas, computes(c::specificVolume));
  tasks.perPatch("mpmice::sumInternalEnergy", sumInternalEnergy<D>, gas, computes(ice::total::internalEnergy));
  tasks.perPatch("mpmice::sumMass", sumMass<D>, requiresOld(c::density), computes(total::gasMass),
                 computes(euler::total::mass));
  tasks.perPatch("mpmice::sumMomentum", sumMomentum<D>, requiresOld(c::momentum<D>), computes(total::gasMomentum),
                 computes(euler::total::momentum));
  tasks.perPatch("mpmice::sumEnergy", euler::sumEnergy<D>, requiresOld(c::totalEnergy), computes(total::gasEnergy));
  if (isEnergyKnown(materials)) scheduleEnergy(tasks, materials);
  tasks.perPatch("mpmice::sumKineticEnergy", sumKineticEnergy<D>, gas, computes(total::gasKineticEnergy),
                 computes(euler::total::kineticEnergy));
  tasks.perPatch("mpmice::findLeastContent", findLeastContent<D>, with(settings_), gas, computes(total::leastMass),
                 computes(total::leastHeat));
  tasks.perPatch("mpmice::sumImpulse", sumVectorOverVolume<D>, requiresOld(c::impulseSinceStart<D>),
                 computes(total::impulse));
  tasks.perPatch("mpmice::sumWork", sumOverVolume<D>, requiresOld(c::workSinceStart), computes(total::work));
  if (hasHeat())
    tasks.perPatch("mpmice::sumHeat", sumOverVolume<D>, requiresOld(c::heatSinceStart), computes(total::heat));
  else
    tasks.perPatch(
        "mpmice::sumHeat", [](const Patch&, Sum&) {}, computes(total::heat));
  if (burns())
    tasks.perPatch("mpmice::sumBurnt", sumBurnt<D>, with(settings_), requiresOld(c::burntSinceStart),
                   computes(total::burntMass), computes(total::reactionHeat));
  for (const auto& one : scalars_) {
    tasks.perPatch("ice::computeScalar", ice::computeScalar<D>, requiresOld(c::density), requiresOld(one->held()),
                   computes(one->value()));
    tasks.perPatch("ice::sumScalar", ice::sumScalar<D>, requiresOld(one->held()), computes(one->total()));
  }
  tasks.perPatch("mpmice::sumLeak", sumOverVolume<D>, requiresOld(c::leakSinceStart), computes(total::leak));
  if (tracers_) ice::scheduleDiagnosticsOfTracers<D>(tasks, *tracers_, tracersAfter(materials));
}

template <int D>
std::vector<simulation::Reported> GasAround<D>::reported() const {
  using enum simulation::Reported::Over;
  std::vector<simulation::Reported> all{
      {"impulse_on_bodies", "impulse of the gas on bodies", "N s", &total::forceOnBodies, time},
      {"work_on_bodies", "work of the gas on bodies", "J", &total::powerOnBodies, time},
      {"leak", "gas that leaked through bodies", "kg", &total::leak, end, true},
      {"merged_cells", "small cells merged, in all steps", "1", &total::mergedCells, sum},
      {"least_free_volume", "smallest open fraction of a cell", "1", &total::leastFreeVolume, least}};
  if (hasHeat())
    all.insert(all.begin() + 2, {"heat_to_bodies", "heat from the gas to bodies", "J", &total::heatOfStep, sum});
  if (burns()) {
    all.push_back({"burnt_mass", "mass of bodies that burned", "kg", &total::burntMass, end});
    all.push_back({"reaction_heat", "heat released by burning", "J", &total::reactionHeat, end});
  }
  if (tracers_) all.push_back(ice::numberOfTracers());
  if (settings_.implicit) all.push_back(simulation::iterationsOfRun(ice::total::iterations));
  return all;
}

template void GasAround<1>::scheduleSums(TaskList&, const Materials&) const;
template void GasAround<2>::scheduleSums(TaskList&, const Materials&) const;
template void GasAround<3>::scheduleSums(TaskList&, const Materials&) const;
template void GasAround<1>::scheduleDiagnostics(TaskList&, const Materials&) const;
template void GasAround<2>::scheduleDiagnostics(TaskList&, const Materials&) const;
template void GasAround<3>::scheduleDiagnostics(TaskList&, const Materials&) const;
template std::vector<simulation::Reported> GasAround<1>::reported() const;
template std::vector<simulation::Reported> GasAround<2>::reported() const;
template std::vector<simulation::Reported> GasAround<3>::reported() const;

}  // namespace tushar::mpmice
