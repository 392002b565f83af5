#pragma once

#include "components/mpm/solid/implicit/conduct_heat.hpp"
#include "components/mpm/solid/implicit/implicit_mpm.hpp"
#include "components/mpm/solid/implicit/system_assembly.hpp"
#include "components/mpm/solid/implicit/system_stiffness.hpp"
#include "components/mpm/solid/implicit/update.hpp"
#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "components/mpm/solid/tasks/boundary_force.hpp"
#include "components/mpm/solid/tasks/damage.hpp"
#include "components/mpm/solid/tasks/diagnose.hpp"
#include "components/mpm/solid/tasks/displacement.hpp"
#include "components/mpm/solid/tasks/heat.hpp"
#include "components/mpm/solid/tasks/show_grid.hpp"

// The schedule of ImplicitMpm: included by the files that instantiate it, one for each kind of shape function.

namespace tushar::mpm::solid::implicit {

template <class Shape>
ImplicitMpm<Shape>::ImplicitMpm(Problem problem, ImplicitMethod how)
    : Solids(std::move(problem), 1),
      how_(std::move(how)),
      heats_(std::any_of(problem_.materials.begin(), problem_.materials.end(),
                         [](const Material& material) { return material.model->changesTemperature(); })),
      is_damageable_(std::any_of(problem_.materials.begin(), problem_.materials.end(),
                                 [](const Material& material) { return material.isDamageable(); })) {}

template <class Shape>
void ImplicitMpm<Shape>::scheduleInitialize(TaskList& tasks) const {
  scheduleActuallyInitialize<D>(tasks, problem_.materials, problem_.start);
  tasks.perMaterial("mpm::initializeStress", initializeStress, problem_.materials, with(state_size_),
                    requiresNew(p::mass), requiresNew(p::deformationMeasure), computes(p::volume), computes(p::stress),
                    when(true, computes(state_)));
  if (is_damageable_)
    tasks.perMaterial("mpm::initializeDamage", initializeDamage, problem_.materials, requiresNew(data::particleId),
                      requiresNew(p::volume), computes(p::damage), computes(p::failureThreshold),
                      computes(p::localized), computes(p::failureTime));
  scheduleStartingAcceleration(tasks);
  tasks.perPatch(
      "impm::allowAnyTimeStep", [](const Patch&, Minimum&) {}, computes(total::nextTimeStep));
}

template <class Shape>
void ImplicitMpm<Shape>::scheduleStartingAcceleration(TaskList& tasks) const {
  if (!how_.dynamic) {
    tasks.perMaterial("impm::startAtRest", startAtRest<D>, problem_.materials, requiresNew(p::mass),
                      computes(p::acceleration<D>));
    return;
  }
  const ImplicitSetup setup{&problem_, how_, state_size_};
  tasks.perMaterial("mpm::applyExternalLoads", applyExternalLoads<D>, problem_.materials, with(problem_.start.loads),
                    startTime(), requiresNew(p::x<D>), requiresNew(p::mass), requiresNew(p::loadCurves),
                    modifies(p::externalForce<D>));
  tasks.perRankAcrossMaterials(
      "impm::accelerateAtStart", accelerateAtStart<Shape>, problem_.materials, togetherOnRanks(), with(setup),
      startTime(), requiresNew(p::x<D>), requiresNew(p::size<D>), requiresNew(p::mass), requiresNew(p::velocity<D>),
      requiresNew(p::externalForce<D>), requiresNew(p::temperature), requiresNew(p::deformationMeasure),
      requiresNew(p::stress), requiresNew(state_), computes(g::newAcceleration<D>));
  tasks.perMaterial("impm::startInMotion", startInMotion<Shape>, problem_.materials, with(setup),
                    requiresNew(g::newAcceleration<D>, Shape::ghostNodes), requiresNew(p::x<D>),
                    requiresNew(p::size<D>), computes(p::acceleration<D>));
}

template <class Shape>
void ImplicitMpm<Shape>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perPatch(
      "impm::limitTimeStep", [](const Patch&, double allowed, Minimum& dt) { dt.add(allowed, "Newton's iterations"); },
      requiresOld(total::nextTimeStep), computes(delT));
  if (how_.dynamic)
    tasks.perMaterial("impm::limitBySpeed", limitBySpeed<D>, problem_.materials, requiresOld(p::velocity<D>),
                      computes(delT));
}

template <class Shape>
void ImplicitMpm<Shape>::scheduleTimeAdvance(TaskList& tasks) const {
  const ImplicitSetup setup{&problem_, how_, state_size_};
  tasks.perMaterial("mpm::applyExternalLoads", applyLoadsAtEnd<D>, problem_.materials, with(problem_.start.loads),
                    startTime(), requiresOld(delT), requiresOld(p::x<D>), requiresOld(p::mass),
                    requiresOld(p::loadCurves), computes(p::externalForce<D>));
  tasks.perRankAcrossMaterials(
      "impm::solve", solveStep<Shape>, problem_.materials, togetherOnRanks(), with(setup), startTime(),
      requiresOld(delT), requiresOld(p::x<D>), requiresOld(p::size<D>), requiresOld(p::mass),
      requiresOld(p::velocity<D>), requiresOld(p::acceleration<D>), requiresNew(p::externalForce<D>),
      requiresOld(p::temperature), requiresOld(p::deformationMeasure), requiresOld(p::stress), requiresOld(state_),
      computes(g::increment<D>), computes(g::newAcceleration<D>), computes(total::newtonIterations),
      computes(total::newtonResidual), computes(total::krylovIterations), computes(total::nextTimeStep),
      computes(solvers::assemblyTime), computes(solvers::preconditionerTime), computes(solvers::solveTime),
      computes(total::rigidReactionForce));
  scheduleMovement(tasks);
  if (is_damageable_) scheduleDamage(tasks);
  scheduleVelocity(tasks);
  scheduleHeat(tasks);
  if (how_.resetsGrid)
    tasks.perMaterial("mpm::addDisplacement", addDisplacement<D>, problem_.materials, requiresOld(p::x<D>),
                      requiresNew(p::x<D>), requiresOld(p::displacement<D>), computes(p::displacement<D>));
  tasks.relocate(p::x<D>, problem_.materials);
}

/// What the displacement of the nodes makes of the particles.
template <class Shape>
void ImplicitMpm<Shape>::scheduleMovement(TaskList& tasks) const {
  const ImplicitSetup setup{&problem_, how_, state_size_};
  if (how_.resetsGrid)
    tasks.perMaterial("impm::moveAndStress", moveAndStress<Shape>, problem_.materials, with(setup), requiresOld(delT),
                      requiresNew(g::increment<D>, Shape::ghostNodes), requiresOld(p::x<D>), requiresOld(p::size<D>),
                      requiresOld(p::mass), requiresOld(p::temperature), requiresOld(p::deformationMeasure),
                      requiresOld(p::stress), requiresOld(state_), computes(p::x<D>), computes(p::deformationMeasure),
                      computes(p::stress), computes(state_), computes(p::volume), computes(p::strainEnergy),
                      when(heats_, computes(p::temperatureChange)));
  else
    tasks.perMaterial("impm::stressInPlace", stressInPlace<Shape>, problem_.materials, with(setup), requiresOld(delT),
                      requiresNew(g::increment<D>, Shape::ghostNodes), requiresOld(p::x<D>), requiresOld(p::size<D>),
                      requiresOld(p::mass), requiresOld(p::temperature), requiresOld(p::deformationMeasure),
                      requiresOld(p::stress), requiresOld(state_), requiresOld(p::displacement<D>), computes(p::x<D>),
                      computes(p::displacement<D>), computes(p::deformationMeasure), computes(p::stress),
                      computes(state_), computes(p::volume), computes(p::strainEnergy),
                      when(heats_, computes(p::temperatureChange)));
}

template <class Shape>
void ImplicitMpm<Shape>::scheduleVelocity(TaskList& tasks) const {
  const ImplicitSetup setup{&problem_, how_, state_size_};
  if (how_.dynamic)
    tasks.perMaterial("impm::advanceVelocity", advanceVelocity<Shape>, problem_.materials, with(setup),
                      requiresOld(delT), requiresNew(g::newAcceleration<D>, Shape::ghostNodes), requiresOld(p::x<D>),
                      requiresOld(p::size<D>), requiresOld(p::velocity<D>), requiresOld(p::acceleration<D>),
                      computes(p::velocity<D>), computes(p::acceleration<D>));
  else {
    const auto& place = how_.resetsGrid ? p::x<D> : p::displacement<D>;
    tasks.perMaterial("impm::meanVelocity", meanVelocity<D>, problem_.materials, requiresOld(delT), requiresOld(place),
                      requiresNew(place), computes(p::velocity<D>), computes(p::acceleration<D>));
  }
}

/// What a scene may save of the temperature on the nodes, conduction, and the heat of the step's work.
template <class Shape>
void ImplicitMpm<Shape>::scheduleHeat(TaskList& tasks) const {
  const ImplicitSetup setup{&problem_, how_, state_size_};
  const int reach = Shape::reach;
  tasks.perMaterial("mpm::interpolateTemperatureToGrid", interpolateTemperatureToGrid<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>, reach),
                    when(true, requiresOld(p::size<D>, reach)), requiresOld(p::deformationMeasure, reach),
                    requiresOld(p::mass, reach), requiresOld(p::temperature, reach), computes(g::heatCapacity),
                    computes(g::temperatureNoBC), computes(g::temperature));
  if (!how_.conductsHeat) {
    if (heats_)
      tasks.perMaterial("mpm::finalParticleUpdate", heatByWorkOfStep, problem_.materials,
                        requiresNew(p::temperatureChange), requiresOld(p::temperature), computes(p::temperature));
    return;
  }
  tasks.perRankAcrossMaterials("impm::conductHeat", conductHeat<Shape>, problem_.materials, togetherOnRanks(),
                               with(setup), requiresOld(delT), requiresOld(p::x<D>), requiresOld(p::size<D>),
                               requiresOld(p::mass), requiresOld(p::temperature), requiresOld(p::deformationMeasure),
                               computes(g::temperatureRate));
  tasks.perMaterial("mpm::updateTemperature", updateTemperature<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>), when(true, requiresOld(p::size<D>)),
                    requiresOld(p::deformationMeasure), requiresOld(p::temperature),
                    requiresNew(g::temperatureRate, Shape::ghostNodes), requiresOld(delT), computes(p::temperature));
  if (heats_)
    tasks.perMaterial("mpm::finalParticleUpdate", addWorkOfStep, problem_.materials, requiresNew(p::temperatureChange),
                      modifies(p::temperature));
}

/// Damage that is only counted.
template <class Shape>
void ImplicitMpm<Shape>::scheduleDamage(TaskList& tasks) const {
  tasks.perMaterial("mpm::computeDamage", computeDamage, problem_.materials, with(state_size_), startTime(),
                    requiresOld(delT), requiresOld(p::temperature), requiresOld(p::damage),
                    requiresOld(p::failureThreshold), requiresOld(p::localized), requiresOld(p::failureTime),
                    requiresNew(p::deformationMeasure), requiresNew(p::volume), when(true, requiresNew(state_)),
                    modifies(p::stress), computes(p::damage), computes(p::failureThreshold), computes(p::localized),
                    computes(p::failureTime));
}

template <class Shape>
void ImplicitMpm<Shape>::scheduleDiagnostics(TaskList& tasks) const {
  scheduleTotals<D>(tasks, problem_.materials, when(false, requiresOld(p::affineMoment)));
  tasks.perMaterial("mpm::computeScaleFactor", computeScaleFactor<D>, problem_.materials,
                    with(problem_.method.commonSize), when(true, requiresOld(p::size<D>)),
                    requiresOld(p::deformationMeasure), computes(p::scaleFactor));
  tasks.perMaterial("mpm::sumVolume", sumParticles, problem_.materials, requiresOld(p::volume),
                    computes(total::volume));
  for (const auto& view : state_views_) view->schedule(tasks, problem_.materials, state_size_, state_);
  scheduleShowOnGrid<Shape>(tasks, problem_.materials, problem_.method.commonSize,
                            when(true, requiresOld(p::size<D>, Shape::reach)), requiresOld(p::volume, Shape::reach),
                            requiresOld(p::stress, Shape::reach));
  scheduleBoundaryForces<D>(tasks, problem_.materials, problem_.method.isThin, requiresOld(p::volume),
                            requiresOld(p::stress));
}

}  // namespace tushar::mpm::solid::implicit
