#include "components/mpm/solid/implicit/implicit_mpm.hpp"
#include "components/mpm/solid/implicit/conduct_heat.hpp"
#include "components/mpm/solid/implicit/system_assembly.hpp"
#include "components/mpm/solid/implicit/system_stiffness.hpp"
#include "components/mpm/solid/implicit/update.hpp"
#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "components/mpm/solid/tasks/boundary_force.hpp"
#include "components/mpm/solid/tasks/damage.hpp"
#include "components/mpm/solid/tasks/diagnose.hpp"
#include "components/mpm/solid/tasks/displacement.hpp"

namespace tushar::mpm::solid::implicit {

template <int D>
ImplicitMpm<D>::ImplicitMpm(Problem problem, const ImplicitShapes<D>& shapes, ImplicitMethod how)
    : Solids(std::move(problem), 1),
      shapes_(&shapes),
      how_(std::move(how)),
      heats_(std::any_of(problem_.materials.begin(), problem_.materials.end(),
                         [](const Material& material) { return material.model->changesTemperature(); })),
      is_damageable_(std::any_of(problem_.materials.begin(), problem_.materials.end(),
                                 [](const Material& material) { return material.isDamageable(); })) {}

template <int D>
void ImplicitMpm<D>::scheduleInitialize(TaskList& tasks) const {
  scheduleActuallyInitialize<D>(tasks, problem_.materials, problem_.start);
  scheduleInitialStress(tasks, problem_.materials, state_);
  if (is_damageable_) scheduleInitialDamage(tasks, problem_.materials);
  scheduleStartingAcceleration(tasks);
  tasks.perPatch(
      "impm::allowAnyTimeStep", [](const Patch&, Minimum&) {}, computes(total::nextTimeStep));
}

template <int D>
void ImplicitMpm<D>::scheduleStartingAcceleration(TaskList& tasks) const {
  if (!how_.dynamic || !how_.movesBodies) {
    tasks.perMaterial("impm::startAtRest", startAtRest<D>, problem_.materials, requiresNew(p::mass),
                      computes(p::acceleration<D>));
    return;
  }
  tasks.perMaterial("mpm::applyExternalLoads", applyExternalLoads<D>, problem_.materials, with(problem_.start.loads),
                    startTime(), requiresNew(p::x<D>), requiresNew(p::mass), requiresNew(p::loadCurves),
                    when(false, requiresNew(p::deformationMeasure)), modifies(p::externalForce<D>));
  tasks.perRankAcrossMaterials("impm::accelerateAtStart", accelerateAtStart<D>, problem_.materials, togetherOnRanks(),
                               with(setup()), startTime(), all<SolidParticles<D>>(AtStart(), &state_),
                               computes(g::newAcceleration<D>));
  tasks.perMaterial("impm::startInMotion", startInMotion<D>, problem_.materials, with(setup()),
                    requiresNew(g::newAcceleration<D>, shapes_->shaped.shape.ghostNodes), requiresNew(p::x<D>),
                    requiresNew(p::size<D>), computes(p::acceleration<D>));
}

template <int D>
void ImplicitMpm<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perPatch(
      "impm::limitTimeStep", [](const Patch&, double allowed, Minimum& dt) { dt.add(allowed, "Newton's iterations"); },
      requiresOld(total::nextTimeStep), computes(delT));
  if (how_.dynamic && how_.movesBodies)
    tasks.perMaterial("impm::limitBySpeed", limitBySpeed<D>, problem_.materials, with(setup()), startTime(),
                      requiresOld(p::velocity<D>), computes(delT));
}

template <int D>
void ImplicitMpm<D>::scheduleTimeAdvance(TaskList& tasks) const {
  if (!how_.movesBodies) return scheduleHeat(tasks);
  tasks.perMaterial("mpm::applyExternalLoads", applyLoadsAtEnd<D>, problem_.materials, with(problem_.start.loads),
                    startTime(), requiresOld(delT), requiresOld(p::x<D>), requiresOld(p::mass),
                    requiresOld(p::loadCurves), computes(p::externalForce<D>));
  tasks.perRankAcrossMaterials("impm::solve", solveStep<D>, problem_.materials, togetherOnRanks(), with(setup()),
                               startTime(), requiresOld(delT), all<SolidParticles<D>>(InStep(), &state_),
                               all<NodalMotion<D>>(), totals<SolveTotals>());
  scheduleMovement(tasks);
  if (is_damageable_) scheduleDamage<D>(tasks, problem_, state_);
  scheduleVelocity(tasks);
  scheduleHeat(tasks);
  if (how_.resetsGrid)
    tasks.perMaterial("mpm::addDisplacement", addDisplacement<D>, problem_.materials, requiresOld(p::x<D>),
                      requiresNew(p::x<D>), requiresOld(p::displacement<D>), computes(p::displacement<D>));
  tasks.relocate(p::x<D>, problem_.materials);
}

/// Adds the tasks that move and deform the particles with the nodes.
template <int D>
void ImplicitMpm<D>::scheduleMovement(TaskList& tasks) const {
  tasks.perMaterial(how_.resetsGrid ? "impm::moveAndStress" : "impm::stressInPlace", moveAndStress<D>,
                    problem_.materials, with(setup()), requiresOld(delT),
                    all<Movement<D>>(shapes_->shaped.shape.ghostNodes, how_.resetsGrid, heats_, &state_));
}

template <int D>
void ImplicitMpm<D>::scheduleVelocity(TaskList& tasks) const {
  if (how_.dynamic)
    tasks.perMaterial("impm::advanceVelocity", advanceVelocity<D>, problem_.materials, with(setup()), startTime(),
                      requiresOld(delT), all<NewmarkUpdate<D>>(shapes_->shaped.shape.ghostNodes));
  else {
    const auto& place = how_.resetsGrid ? p::x<D> : p::displacement<D>;
    tasks.perMaterial("impm::meanVelocity", meanVelocity<D>, problem_.materials, requiresOld(delT), requiresOld(place),
                      requiresNew(place), computes(p::velocity<D>), computes(p::acceleration<D>));
  }
}

/// Adds the temperature on the nodes, which a scene may save, conduction, and the heat of the step's work.
template <int D>
void ImplicitMpm<D>::scheduleHeat(TaskList& tasks) const {
  const Vec3& commonSize = problem_.method.commonSize;
  scheduleNodalTemperature(tasks, shapes_->shaped, problem_.materials, commonSize, keepsSizes, false);
  if (how_.conductsHeat) {
    if (isHeatedByLoads())
      tasks.perMaterial("mpm::applyHeatFlux", applyHeatFluxAtEnd<D>, problem_.materials, with(problem_.start.loads),
                        startTime(), requiresOld(delT), requiresOld(p::x<D>), requiresOld(p::loadCurves),
                        computes(p::heatFlux));
    tasks.perRankAcrossMaterials("impm::conductHeat", conductHeat<D>, problem_.materials, togetherOnRanks(),
                                 with(setup()), requiresOld(delT), all<HeatedParticles<D>>(isHeatedByLoads()),
                                 computes(g::temperatureRate));
    scheduleTemperatureUpdate(tasks, shapes_->shaped, problem_.materials, commonSize, keepsSizes, false);
  }
  if (heats_ && how_.movesBodies) scheduleHeatOfWork(tasks, problem_.materials, how_.conductsHeat);
}

template <int D>
void ImplicitMpm<D>::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perMaterial("impm::findDeformedPosition", findDeformedPosition<D>, problem_.materials, requiresOld(p::x<D>),
                    when(!how_.resetsGrid, requiresOld(p::displacement<D>)), computes(p::deformedPosition<D>));
  scheduleTotals<D>(tasks, problem_.materials, problem_.method, keepsSizes,
                    how_.resetsGrid ? nullptr : &p::deformedPosition<D>);
  tasks.perMaterial("mpm::sumVolume", sumParticles, problem_.materials, requiresOld(p::volume),
                    computes(total::volume));
  for (const auto& view : state_views_) view->schedule(tasks, problem_.materials, state_size_, state_);
  const int reach = shapes_->shaped.shape.reach;
  scheduleShowOnGrid(tasks, shapes_->shaped, problem_.materials, problem_.method.commonSize, keepsSizes,
                     requiresOld(p::volume, reach), requiresOld(p::stress, reach));
  scheduleBoundaryForces<D>(tasks, problem_, requiresOld(p::volume), requiresOld(p::stress));
}

template class ImplicitSystem<1>;
template class ImplicitSystem<2>;
template class ImplicitSystem<3>;
template class ImplicitMpm<1>;
template class ImplicitMpm<2>;
template class ImplicitMpm<3>;

}  // namespace tushar::mpm::solid::implicit
