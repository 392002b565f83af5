#include "components/mpm/solid/explicit/solid_mpm.hpp"

#include "components/mpm/solid/cohesive/schedule_zones.hpp"
#include "components/mpm/solid/explicit/tasks/integrate_acceleration.hpp"
#include "components/mpm/solid/explicit/tasks/prescribe_motion.hpp"
#include "components/mpm/solid/explicit/tasks/transmit_force.hpp"
#include "components/mpm/solid/grains/form_clusters.hpp"

// The schedule of SolidMpm, which can be read as the method.

namespace tushar::mpm::solid {

template <int D>
void SolidMpm<D>::scheduleTimeAdvance(TaskList& tasks) const {
  scheduleStep(tasks, problem_.method.stressUpdate);
}

template <int D>
void SolidMpm<D>::scheduleCarefulTimeAdvance(TaskList& tasks) const {
  const Method& method = problem_.method;
  const bool needsUsl = method.affine || method.projectsGradient || problem_.motion || problem_.surroundings;
  if (method.stressUpdate == StressUpdate::last && method.removesLost && !needsUsl)
    scheduleStep(tasks, StressUpdate::modifiedLast);
}

template <int D>
std::string SolidMpm<D>::aboutCarefulSteps() const {
  return "velocities are interpolated to the nodes once more for the stresses (stress_update musl)";
}

template <int D>
void SolidMpm<D>::scheduleNextMaterials(TaskList& tasks) const {
  const Method& method = problem_.method;
  if (method.isGranular)
    tasks.perRankAcrossMaterials("mpm::formClusters", formClusters<D>, problem_.materials, togetherOnRanks(),
                                 with(method.commonSize), all<ClusterSources<D>>(method.keepsSizes));
}

template <int D>
void SolidMpm<D>::scheduleStep(TaskList& tasks, StressUpdate stressUpdate) const {
  if (isLoaded()) scheduleApplyExternalLoads(tasks);
  switch (stressUpdate) {
    case StressUpdate::last:
      scheduleMomentum(tasks, readsOld);
      problem_.method.sharesVolume ? scheduleUpdateInCells(tasks) : scheduleUpdateParticles(tasks);
      scheduleVelocityUpdate(tasks, readsOld);
      break;
    case StressUpdate::modifiedLast:
      scheduleMomentum(tasks, readsOld);
      scheduleMoveParticles(tasks, readsOld);
      scheduleVelocityUpdate(tasks, readsOld);
      scheduleInterpolateMomentum(tasks, readsNew);
      scheduleComputeStressTensor(tasks, g::stressRecord);
      break;
    case StressUpdate::first:
      scheduleInterpolateMomentum(tasks, readsOld);
      scheduleComputeStressTensor(tasks, g::stressRecord);
      scheduleMomentum(tasks, readsNew);
      scheduleMoveParticles(tasks, readsNew);
      scheduleVelocityUpdate(tasks, readsNew);
      break;
  }
  scheduleEndOfStep(tasks);
}

template <int D>
void SolidMpm<D>::scheduleMomentum(TaskList& tasks, Reads stressed) const {
  scheduleInterpolateParticlesToGrid(tasks, stressed);
  scheduleIntegrateAcceleration(tasks);
  scheduleMeasureWork(tasks, stressed);
  scheduleHeat(tasks);
}

/// Adds the interpolation to the grid, with the forces of the stresses: Uintah's computeInternalForce. `stressed` reads
/// F and the stress.
template <int D>
void SolidMpm<D>::scheduleInterpolateParticlesToGrid(TaskList& tasks, Reads stressed) const {
  const int reach = shapes_.reach;
  Keeps scattered = keeps();
  scattered.externalForce = isLoaded() && !problem_.method.loadsAtCorners;
  tasks.perMaterial(
      "mpm::interpolateParticlesToGrid", bodies_->interpolateParticlesToGrid, problem_.materials,
      with(problem_.method.commonSize), with(clearsAllNodes()),
      all<MomentumSources<D>>(reach, keepsSizes(), requiresOld(p::velocity<D>, reach),
                              when(!keeps_stress_ || shapes_.deform, stressed(p::deformationMeasure, reach))),
      all<ForceSources<D>>(reach, scattered, stressed), computesOwn(g::record));
  scheduleCornerLoads(tasks);
  if (problem_.method.affine && bodies_->addAffineVelocity)
    tasks.perMaterial("mpm::addAffineVelocity", bodies_->addAffineVelocity, problem_.materials,
                      with(problem_.method.commonSize), all<Placed<D>>(shapes_, keepsSizes(), reach),
                      requiresOld(p::mass, reach), requiresOld(p::affineMoment, reach), modifies(g::record));
  if (problem_.method.projectsGradient)
    tasks.perMaterial("mpm::addVelocityGradient", bodies_->addVelocityGradient, problem_.materials,
                      with(problem_.method.commonSize), all<Placed<D>>(shapes_, keepsSizes(), reach),
                      requiresOld(p::mass, reach), requiresOld(p::velocityGradient, reach), modifies(g::record));
  if (hasPlanes()) scheduleSeparateBodies(tasks);
  if (!problem_.contacts.empty()) scheduleContact(tasks, "mpm::exMomInterpolated", Moment::start, g::record);
  if (problem_.method.stressUpdate != StressUpdate::first) scheduleComputeSurface(tasks, g::record);
  if (hasFriction()) scheduleFriction(tasks, "mpm::frictionInterpolated", Moment::start, g::record);
}

/// Adds the task that computes the surfaces of bodies at nodes where, by the masses in `record`, bodies meet. Called
/// once per step.
template <int D>
void SolidMpm<D>::scheduleComputeSurface(TaskList& tasks, const NodeLabel<NodeRecord>& record) const {
  if (!hasFriction()) return;
  tasks.acrossMaterials("mpm::computeSurface", bodies_->computeSurface, problem_.materials,
                        with(problem_.method.commonSize), requiresNew(record),
                        all<SurfaceSources<D>>(shapes_.reach, keeps()));
}

template <int D>
void SolidMpm<D>::scheduleIntegrateAcceleration(TaskList& tasks) const {
  scheduleSurroundingForce(tasks);
  if (hasZones()) scheduleZoneForces<D>(tasks, problem_);
  tasks.perMaterial("mpm::computeAndIntegrateAcceleration", computeAndIntegrateAcceleration<D>, problem_.materials,
                    with(problem_.method), with(shapes_.ghostNodes), requiresOld(p::x<D>, shapes_.reach),
                    requiresOld(delT), modifies(g::record));
  scheduleKeepVelocity(tasks, g::velocityOfForces<D>);
  scheduleContactAtEnd(tasks);
  if (hasFriction()) scheduleFriction(tasks, "mpm::frictionIntegrated", Moment::end, g::record, rubbingHeats());
  scheduleKeepVelocity(tasks, g::velocityOfContact<D>);
  tasks.perMaterial("mpm::setGridBoundaryConditions", setGridBoundaryConditions<D>, problem_.materials,
                    with(shapes_.ghostNodes), requiresOld(p::x<D>, shapes_.reach), modifies(g::record));
  schedulePrescribedMotion(tasks, g::record);
  if (transmitsForce()) scheduleTransmittedForce(tasks);
  if (hasZones()) scheduleZoneMotion<D>(tasks, problem_);
}

template <int D>
void SolidMpm<D>::schedulePrescribedMotion(TaskList& tasks, const NodeLabel<NodeRecord>& record) const {
  if (problem_.motion)
    tasks.perMaterial("mpm::prescribeMotion", prescribeMotion<D>, problem_.materials, with(problem_.motion.get()),
                      with(shapes_.ghostNodes), startTime(), requiresOld(p::x<D>, shapes_.reach), modifies(record));
}

/// Adds the work of a step, except that of the stresses (see scheduleStrainWork). The tasks of both run only if work is
/// saved or reported. `shaped` reads the F that shape functions follow.
template <int D>
void SolidMpm<D>::scheduleMeasureWork(TaskList& tasks, Reads shaped) const {
  scheduleNodalWork(tasks);
  tasks.perMaterial("mpm::measureWork", bodies_->measureWork, problem_.materials, with(problem_.method.commonSize),
                    requiresOld(delT), all<ParticleWork<D>>(shapes_, keeps(), shapedBy(shaped)));
}
/// Adds the update of particles, with the gradients and the stresses: Uintah's computeParticleGradients and
/// computeStressTensor.
template <int D>
void SolidMpm<D>::scheduleUpdateParticles(TaskList& tasks) const {
  tasks.perMaterial("mpm::interpolateToParticlesAndUpdate", bodies_->interpolateToParticlesAndUpdate,
                    problem_.materials, with(problem_.method), startTime(), requiresOld(delT),
                    all<ParticleUpdate<D>>(shapes_.ghostNodes, keeps()));
  scheduleDamage(tasks);
}

/// Adds first the motion of particles, then the update of F and the stress, because the particles of a cell share one
/// change of volume.
template <int D>
void SolidMpm<D>::scheduleUpdateInCells(TaskList& tasks) const {
  scheduleMoveParticles(tasks, readsOld);
  scheduleComputeStressTensor(tasks, g::record);
}

/// Adds the update of x and v only; `shaped` reads the F that shape functions follow.
template <int D>
void SolidMpm<D>::scheduleMoveParticles(TaskList& tasks, Reads shaped) const {
  tasks.perMaterial("mpm::interpolateToParticlesAndUpdate", bodies_->moveParticles, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(delT),
                    all<MotionUpdate<D>>(shapes_.ghostNodes, keepsSizes(), shapedBy(shaped)));
}

/// Adds the velocity update that replaces FLIP; `shaped` reads the F that shape functions follow.
template <int D>
void SolidMpm<D>::scheduleVelocityUpdate(TaskList& tasks, Reads shaped) const {
  const auto particles = all<Placed<D>>(keepsSizes(), 0, shapedBy(shaped));
  const auto record = requiresNew(g::record, shapes_.ghostNodes);
  const auto& [materials, method] = std::tie(problem_.materials, problem_.method);
  if (method.picFraction > 0)
    tasks.perMaterial("mpm::blendVelocity", bodies_->blendVelocity, materials, with(method), record, particles,
                      modifies(p::velocity<D>));
  if (method.xpic) {
    const int reach = shapes_.reach;
    tasks.perMaterial("mpm::computeSSPlusVp", bodies_->computeSSPlusVp, materials, with(method.commonSize), record,
                      particles, computes(p::smoothVelocity<D>));
    tasks.perMaterial(
        "mpm::computeSPlusSSPlusVp", bodies_->interpolateMomentum, materials, with(method.commonSize), with(false),
        all<MomentumSources<D>>(reach, keepsSizes(), requiresNew(p::smoothVelocity<D>, reach), shapedBy(shaped, reach)),
        computesOwn(g::smoothRecord));
    tasks.perMaterial("mpm::applyXpic", bodies_->applyXpic, materials, with(method.commonSize), requiresOld(delT),
                      all<XpicUpdate<D>>(shapes_.ghostNodes, keepsSizes(), shapedBy(shaped)));
  }
  if (method.affine && bodies_->updateAffineMoment)
    tasks.perMaterial("mpm::updateAffineMoment", bodies_->updateAffineMoment, materials, with(method.commonSize),
                      record, particles, computes(p::affineMoment));
}

/// Adds the tasks that interpolate velocities to the nodes once more. They are needed if stresses are not computed from
/// the velocity with which particles move. `moving` reads the particles' velocity.
template <int D>
void SolidMpm<D>::scheduleInterpolateMomentum(TaskList& tasks, Reads moving) const {
  const int reach = shapes_.reach;
  tasks.perMaterial(
      "mpm::interpolateMomentum", bodies_->interpolateMomentum, problem_.materials, with(problem_.method.commonSize),
      with(clearsAllNodes()),
      all<MomentumSources<D>>(reach, keepsSizes(), moving(p::velocity<D>, reach), shapedBy(readsOld, reach)),
      computesOwn(g::stressRecord));
  if (!problem_.contacts.empty()) scheduleContact(tasks, "mpm::exMomOfStresses", Moment::end, g::stressRecord);
  if (problem_.method.stressUpdate == StressUpdate::first) scheduleComputeSurface(tasks, g::stressRecord);
  if (hasFriction()) scheduleFriction(tasks, "mpm::frictionOfStresses", Moment::end, g::stressRecord);
  tasks.perMaterial("mpm::setGridBoundaryConditionsOfStresses", setGridBoundaryConditions<D>, problem_.materials,
                    with(shapes_.ghostNodes), requiresOld(p::x<D>, reach), modifies(g::stressRecord));
  schedulePrescribedMotion(tasks, g::stressRecord);
}

/// Adds the update of F and the stress, separately from the motion, with the velocity in `record`.
template <int D>
void SolidMpm<D>::scheduleComputeStressTensor(TaskList& tasks, const NodeLabel<NodeRecord>& record) const {
  const Method& method = problem_.method;
  const bool removes = method.removesLost && method.stressUpdate != StressUpdate::first;
  const auto body = method.sharesVolume ? bodies_->computeSharedStressTensor : bodies_->computeStressTensor;
  tasks.perMaterial("mpm::computeStressTensor", body, problem_.materials, with(method), startTime(), requiresOld(delT),
                    all<StateUpdate<D>>(shapes_.ghostNodes, keeps(), &record, removes));
  scheduleDamage(tasks);
}

template <int D>
void SolidMpm<D>::scheduleShowOnGrid(TaskList& tasks, Reads stressed) const {
  solid::scheduleShowOnGrid(tasks, bodies_->shaped, problem_.materials, problem_.method.commonSize, keepsSizes(),
                            stressed(p::volume, shapes_.reach), stressed(p::stress, shapes_.reach), this->isViscous());
}

/// Adds the tasks that find the planes along which bodies slide.
template <int D>
void SolidMpm<D>::scheduleSeparateBodies(TaskList& tasks) const {
  const auto& [materials, commonSize] = std::tie(problem_.materials, problem_.method.commonSize);
  tasks.acrossMaterials("mpm::separateBodies", bodies_->separateBodies, materials, with(problem_.contacts),
                        with(commonSize), requiresNew(g::record),
                        all<PlaneSources<D>>(shapes_, keepsSizes(), problem_.method.keepsSizes));
  if (frictionHasColor())
    tasks.perMaterial("mpm::interpolateColor", bodies_->interpolateColor, materials, with(commonSize),
                      all<Placed<D>>(shapes_, keepsSizes(), shapes_.reach), requiresOld(p::mass, shapes_.reach),
                      requiresOld(p::color, shapes_.reach), requiresNew(g::record), computes(g::color));
}

template <int D>
void SolidMpm<D>::scheduleTransmittedForce(TaskList& tasks) const {
  tasks.perRankAcrossMaterials("mpm::computeGridVelocityForFTM", computeGridVelocityForFTM<D>, problem_.materials,
                               togetherOnRanks(), with(shapes_.ghostNodes), requiresOld(delT),
                               all<RigidMotion<D>>(shapes_.reach, problem_.surroundings != nullptr));
}

/// Adds tasks for the temperature, which run only in scenes that read or save it.
template <int D>
void SolidMpm<D>::scheduleHeat(TaskList& tasks) const {
  if (!problem_.method.conductsHeat) return;
  const auto& [materials, commonSize] = std::tie(problem_.materials, problem_.method.commonSize);
  const bool isAnyGiven = problem_.method.givesTemperatures;
  scheduleNodalTemperature(tasks, bodies_->shaped, materials, commonSize, keepsSizes(), isAnyGiven);
  scheduleShareTemperature(tasks);
  if (isAnyGiven)
    tasks.perMaterial("mpm::followGivenTemperature", bodies_->followGivenTemperature, materials, with(commonSize),
                      all<NearGivenTemperature<D>>(shapes_, keepsSizes()));
  scheduleHeatFlux(tasks);
  tasks.perMaterial("mpm::computeInternalHeatRate", bodies_->computeInternalHeatRate, materials, with(commonSize),
                    all<HeatFlow<D>>(shapes_, keepsSizes(), problem_.start.loads.hasHeat()));
  tasks.perMaterial("mpm::computeSubgridHeat", bodies_->computeSubgridHeat, materials, with(commonSize),
                    all<SubgridHeat<D>>(shapes_, keepsSizes()), requiresOld(delT));
  scheduleTemperatureRate(tasks);
  scheduleTemperatureUpdate(tasks, bodies_->shaped, materials, commonSize, keepsSizes(), true);
}

template class SolidMpm<1>;
template class SolidMpm<2>;
template class SolidMpm<3>;

}  // namespace tushar::mpm::solid
