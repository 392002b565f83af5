#include "components/mpm/solid/explicit/solids_of.hpp"

#include "components/mpm/solid/cohesive/schedule_zones.hpp"
#include "components/mpm/solid/explicit/tasks/affine.hpp"
#include "components/mpm/solid/explicit/tasks/corner_loads.hpp"
#include "components/mpm/solid/explicit/tasks/exchange_momentum.hpp"
#include "components/mpm/solid/explicit/tasks/friction.hpp"
#include "components/mpm/solid/explicit/tasks/measure_work.hpp"
#include "components/mpm/solid/explicit/tasks/separate_bodies.hpp"
#include "components/mpm/solid/explicit/tasks/stable_time_step.hpp"
#include "components/mpm/solid/explicit/tasks/transmit_force.hpp"
#include "components/mpm/solid/explicit/tasks/velocity_updates.hpp"
#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "components/mpm/solid/tasks/boundary_force.hpp"
#include "components/mpm/solid/tasks/damage.hpp"
#include "components/mpm/solid/tasks/diagnose.hpp"
#include "components/mpm/solid/tasks/displacement.hpp"
#include "components/mpm/solid/tasks/heat.hpp"
#include "components/mpm/solid/tasks/insert_particles.hpp"
#include "components/mpm/solid/tasks/nonlocal.hpp"
#include "components/mpm/solid/tasks/show_grid.hpp"
#include "components/mpm/solid/tasks/surrounding_force.hpp"

namespace tushar::mpm::solid {

template <int D>
SolidsOf<D>::SolidsOf(Problem problem, const ShapeTraits& shapes) : Solids(std::move(problem)), shapes_(shapes) {
  const auto any = [&](auto&& holds) {
    return std::any_of(problem_.materials.begin(), problem_.materials.end(),
                       [&](const Material& m) { return holds(*m.model); });
  };
  is_damageable_ = std::any_of(problem_.materials.begin(), problem_.materials.end(),
                               [](const Material& material) { return material.isDamageable(); });
  keeps_stress_ = is_damageable_ || any([](const Model& model) { return !model.dependsOnDeformationOnly(); });
  is_thermal_ = any([](const Model& model) { return model.usesTemperature(); });
  heats_ = any([](const Model& model) { return model.changesTemperature(); });
}

template <int D>
void SolidsOf<D>::scheduleInitialize(TaskList& tasks) const {
  if (hasZones()) scheduleNewZones<D>(tasks, problem_);
  scheduleActuallyInitialize<D>(tasks, problem_.materials, problem_.start);
  tasks.perMaterial("mpm::computeInitialTimeStep", computeInitialTimeStep<D>, problem_.materials,
                    requiresNew(p::velocity<D>), requiresNew(p::temperature), requiresNew(p::deformationMeasure),
                    computes(total::stableTimeStep), offers(c::stableTimeStep));
  if (keeps_stress_) scheduleInitialStress(tasks, problem_.materials, state_);
  if (hasPlanes())
    tasks.perMaterial("mpm::findSurface", findSurface<D>, problem_.materials, requiresNew(p::x<D>),
                      computes(p::surface));
  if (problem_.method.affine)
    tasks.perMaterial("mpm::initializeAffineMoment", initializeAffineMoment, problem_.materials, requiresNew(p::mass),
                      computes(p::affineMoment));
  tasks.perMaterial("mpm::startWork", startWork<D>, problem_.materials, requiresNew(p::mass),
                    requiresNew(p::velocity<D>), computes(p::work));
  if (is_damageable_) scheduleInitialDamage(tasks, problem_.materials);
  if (problem_.surroundings) problem_.surroundings->scheduleStart(tasks, problem_.materials);
}

template <int D>
void SolidsOf<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perPatch("mpm::computeStableTimeStep", limitByWaves, requiresOld(total::stableTimeStep), computes(delT));
}

template <int D>
std::string SolidsOf<D>::whyOneLevel() const {
  if (hasZones()) return "cohesive zones do not look for nodes of finer cells";
  return transmitsForce() ? "a body with <is_force_transmitting_material> moves by the forces on all of it" : "";
}

template <int D>
std::string SolidsOf<D>::whyOneBox() const {
  if (problem_.start.solution) return "the solution of <RunMMSProblem> fills the box around the boxes";
  if (hasZones()) return "cohesive zones would glue bodies through walls";
  if (problem_.method.nonlocalLayers > 0) return "a nonlocal model averages over particles behind walls, too";
  return "";
}

template <int D>
void SolidsOf<D>::scheduleApplyExternalLoads(TaskList& tasks) const {
  if (problem_.start.solution)
    tasks.perMaterial("mpm::applyExternalLoads", applyManufacturedForce<D>, problem_.materials,
                      with(problem_.start.solution.get()), startTime(), requiresOld(p::x<D>),
                      requiresOld(p::displacement<D>), requiresOld(p::mass), computes(p::externalForce<D>));
  else if (problem_.method.loadsAtCorners)
    tasks.perMaterial("mpm::applyExternalLoads", applyLoadsAtCorners<D>, problem_.materials, with(problem_.start.loads),
                      with(problem_.method.commonSize), startTime(), all<LoadedParticles<D>>(boxSizes(), 0),
                      computes(p::externalForce<D>));
  else
    tasks.perMaterial("mpm::applyExternalLoads", applyExternalLoads<D>, problem_.materials, with(problem_.start.loads),
                      startTime(), requiresOld(p::x<D>), requiresOld(p::mass), requiresOld(p::loadCurves),
                      when(problem_.method.turnsPressures, requiresOld(p::deformationMeasure)),
                      computes(p::externalForce<D>));
}

template <int D>
void SolidsOf<D>::scheduleFriction(TaskList& tasks, const std::string& name, Moment moment,
                                   const NodeLabel<NodeRecord>& record, bool heats) const {
  tasks.acrossMaterials(name, exchangeByFriction<D>, problem_.materials, with(problem_.contacts), with(moment),
                        with(shapes_.ghostNodes), requiresOld(p::x<D>, shapes_.reach), requiresOld(delT),
                        requiresNew(g::surfaceRecord), modifies(record), when(heats, computes(g::frictionHeat)));
}

template <int D>
void SolidsOf<D>::scheduleKeepVelocity(TaskList& tasks, const NodeLabel<Vec<D>>& kept) const {
  tasks.perMaterial("mpm::keepVelocity", keepVelocity<D>, problem_.materials, with(shapes_.ghostNodes),
                    requiresOld(p::x<D>, shapes_.reach), requiresNew(g::record), computes(kept));
}

template <int D>
void SolidsOf<D>::scheduleStrainWork(TaskList& tasks) const {
  tasks.perMaterial("mpm::measureStrainWork", measureStrainWork, problem_.materials,
                    all<StrainWork>(keeps(), readsOld, readsNew));
  if (keeps_stress_ && state_size_ > 0)
    tasks.perMaterial("mpm::measurePlasticWork", measurePlasticWork, problem_.materials, with(state_size_),
                      requiresOld(state_), requiresNew(state_), requiresNew(p::volume), requiresNew(p::stress),
                      modifies(p::work));
}

/// Adds the average of the plastic strain around each particle, for the next step.
template <int D>
void SolidsOf<D>::scheduleNonlocalPlasticity(TaskList& tasks) const {
  const int layers = problem_.method.nonlocalLayers;
  if (layers == 0) return;
  tasks.perMaterial("mpm::findPlasticIncrement", findPlasticIncrement, problem_.materials, with(state_size_),
                    requiresNew(state_), computes(p::plasticIncrement));
  tasks.perMaterial("mpm::averagePlasticIncrement", averagePlasticIncrement<D>, problem_.materials, with(layers),
                    with(state_size_), requiresOld(p::x<D>, layers), requiresOld(p::volume, layers),
                    requiresNew(p::plasticIncrement, layers), modifies(state_));
}

template <int D>
void SolidsOf<D>::scheduleDamage(TaskList& tasks) const {
  if (is_damageable_) solid::scheduleDamage<D>(tasks, problem_, state_);
}

/// Adds contacts other than stress-based friction, for the velocities in a record.
template <int D>
void SolidsOf<D>::scheduleContact(TaskList& tasks, const std::string& name, Moment moment,
                                  const NodeLabel<NodeRecord>& record) const {
  tasks.acrossMaterials(name, exchangeMomentum<D>, problem_.materials, with(problem_.contacts), with(moment),
                        startTime(), requiresOld(delT), modifies(record),
                        all<SeparatingPlane<D>>(hasPlanes(), frictionHasColor(), shapes_));
}

template <int D>
void SolidsOf<D>::scheduleContactAtEnd(TaskList& tasks) const {
  const Acceleration acceleration{problem_.method.gravity, problem_.method.damping};
  if (problem_.contacts.empty() && !transmitsForce()) return;
  tasks.acrossMaterials("mpm::exMomIntegrated", exchangeMomentumAtEnd<D>, problem_.materials, with(problem_.contacts),
                        with(acceleration), startTime(), requiresOld(delT), modifies(g::record),
                        all<SeparatingPlane<D>>(hasPlanes(), frictionHasColor(), shapes_),
                        computes(total::rigidReactionForce), when(transmitsForce(), computes(g::transmittedForce<D>)));
}

/// Adds the tasks that follow the forces and stresses of a step.
template <int D>
void SolidsOf<D>::scheduleEndOfStep(TaskList& tasks) const {
  if (problem_.method.maximumParticleVelocity)
    tasks.perMaterial("mpm::limitVelocity", limitVelocity<D>, problem_.materials,
                      with(*problem_.method.maximumParticleVelocity), requiresOld(p::velocity<D>),
                      modifies(p::velocity<D>));
  if (problem_.surroundings && transmitsForce() && problem_.contacts.empty())
    tasks.perMaterial("mpm::moveByMeanVelocity", moveByMeanVelocity<D>, problem_.materials, requiresOld(delT),
                      requiresOld(p::velocity<D>), requiresNew(p::velocity<D>), modifies(p::x<D>));
  if (heats_) scheduleHeatOfWork(tasks, problem_.materials, problem_.method.conductsHeat);
  scheduleStrainWork(tasks);
  scheduleNonlocalPlasticity(tasks);
  tasks.perMaterial("mpm::addDisplacement", addDisplacement<D>, problem_.materials, requiresOld(p::x<D>),
                    requiresNew(p::x<D>), requiresOld(p::displacement<D>), computes(p::displacement<D>));
  if (problem_.surroundings && problem_.surroundings->exchangesHeat() && !problem_.method.conductsHeat && !heats_)
    tasks.perMaterial("mpm::keepTemperature", keepTemperature, problem_.materials, requiresOld(p::temperature),
                      computes(p::temperature));
  if (problem_.surroundings) problem_.surroundings->scheduleMotion(tasks, problem_.materials);
  if (!problem_.insertions.empty())
    tasks.perMaterial("mpm::insertParticles", insertParticles<D>, problem_.materials, with(problem_.insertions),
                      startTime(), requiresOld(delT), requiresOld(p::color), modifies(p::x<D>),
                      modifies(p::velocity<D>));
  if (problem_.surroundings)
    problem_.surroundings->scheduleRelocation(tasks, problem_.materials);
  else if (hasZones())
    tasks.relocate(p::x<D>, following(problem_.materials, problem_.zones));
  else
    tasks.relocate(p::x<D>, problem_.materials);
}

/// Adds the forces that act at the corners of particles.
template <int D>
void SolidsOf<D>::scheduleCornerLoads(TaskList& tasks) const {
  if (!problem_.method.loadsAtCorners || !isLoaded()) return;
  tasks.perMaterial("mpm::addLoadsAtCorners", addLoadsAtCorners<D>, problem_.materials, with(problem_.start.loads),
                    with(problem_.method.commonSize), with(shapes_.haveSizes && !shapes_.deform), startTime(),
                    all<LoadedParticles<D>>(boxSizes(), static_cast<int>(cornerReach)), modifies(g::record));
}

template <int D>
void SolidsOf<D>::scheduleSurroundingForce(TaskList& tasks) const {
  if (!problem_.surroundings) return;
  problem_.surroundings->scheduleForces(tasks, problem_.materials, state_);
  tasks.perMaterial("mpm::addSurroundingForce", addSurroundingForce<D>, problem_.materials, with(shapes_.ghostNodes),
                    requiresOld(p::x<D>, shapes_.reach), requiresNew(g::surroundingForce<D>), modifies(g::record));
}

template <int D>
void SolidsOf<D>::scheduleNodalWork(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeNodalWork", computeNodalWork<D>, problem_.materials, with(problem_.method),
                    with(shapes_.ghostNodes), requiresOld(p::x<D>, shapes_.reach), requiresOld(delT),
                    requiresNew(g::record), requiresNew(g::velocityOfForces<D>),
                    when(!problem_.contacts.empty(), requiresNew(g::velocityOfContact<D>)), computes(g::workRecord));
}

template <int D>
void SolidsOf<D>::scheduleHeatFlux(TaskList& tasks) const {
  if (!problem_.start.loads.hasHeat()) return;
  tasks.perMaterial("mpm::applyHeatFlux", applyHeatFlux<D>, problem_.materials, with(problem_.start.loads), startTime(),
                    requiresOld(p::x<D>), requiresOld(p::loadCurves), computes(p::heatFlux));
}

template <int D>
void SolidsOf<D>::scheduleShareTemperature(TaskList& tasks) const {
  if (!problem_.method.thermalContact) return;
  tasks.acrossMaterials("mpm::shareTemperature", shareTemperature<D>, problem_.materials, requiresNew(g::heatCapacity),
                        modifies(g::temperatureNoBC), modifies(g::temperature));
}

/// Adds the temperatures of nodes at the end of the step, with the heat of contact and friction.
template <int D>
void SolidsOf<D>::scheduleTemperatureRate(TaskList& tasks) const {
  const bool hasContact = problem_.method.thermalContact;
  if (hasContact)
    tasks.acrossMaterials("mpm::computeHeatExchange", computeHeatExchange<D>, problem_.materials,
                          all<HeatOfMaterial>(rubbingHeats()), requiresOld(delT), computes(g::contactTemperatureRate));
  tasks.perMaterial("mpm::integrateTemperatureRate", integrateTemperatureRate<D>, problem_.materials,
                    all<NodalHeating>(hasContact, rubbingHeats(), problem_.method.givesTemperatures),
                    requiresOld(delT));
}

template <int D>
void SolidsOf<D>::scheduleDiagnostics(TaskList& tasks) const {
  const Reads stressed = keeps_stress_ ? readsOld : readsNew;
  scheduleTotals<D>(tasks, problem_.materials, problem_.method, keepsSizes(), nullptr);
  for (std::size_t k = 0; k < total::work.size(); ++k)
    tasks.perMaterial("mpm::sumWork", sumWork, problem_.materials, with(static_cast<int>(k)), requiresOld(p::work),
                      computes(total::work[k]));
  if (hasZones()) scheduleZoneTotals<D>(tasks, problem_);
  if (!is_damageable_)
    tasks.perMaterial("mpm::showSound", showSound, problem_.materials, requiresOld(p::mass), computes(p::localized));
  for (const auto& view : state_views_) view->schedule(tasks, problem_.materials, state_size_, state_);
  if (!keeps_stress_) {
    tasks.perMaterial("mpm::computeVolume", computeVolume, problem_.materials, requiresOld(p::mass, shapes_.reach),
                      requiresOld(p::deformationMeasure, shapes_.reach), computes(p::volume));
    tasks.perMaterial("mpm::computeStress", computeStress, problem_.materials, requiresOld(p::deformationMeasure),
                      computes(p::stress));
  }
  scheduleShowOnGrid(tasks, stressed);
  scheduleBoundaryForces<D>(tasks, problem_, stressed(p::volume), stressed(p::stress), isViscous());
  tasks.perMaterial("mpm::sumVolume", sumParticles, problem_.materials, stressed(p::volume), computes(total::volume));
}

template void scheduleTotals<1>(TaskList&, const std::vector<Material>&, const Method&, KeptSizes,
                                const ParticleLabel<Vec<1>>*);
template void scheduleTotals<2>(TaskList&, const std::vector<Material>&, const Method&, KeptSizes,
                                const ParticleLabel<Vec<2>>*);
template void scheduleTotals<3>(TaskList&, const std::vector<Material>&, const Method&, KeptSizes,
                                const ParticleLabel<Vec<3>>*);

template void scheduleActuallyInitialize<1>(TaskList&, const std::vector<Material>&, const Start&);
template void scheduleActuallyInitialize<2>(TaskList&, const std::vector<Material>&, const Start&);
template void scheduleActuallyInitialize<3>(TaskList&, const std::vector<Material>&, const Start&);

template class SolidsOf<1>;
template class SolidsOf<2>;
template class SolidsOf<3>;

}  // namespace tushar::mpm::solid
