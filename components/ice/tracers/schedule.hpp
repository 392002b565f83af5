#pragma once

#include "components/euler/labels.hpp"
#include "components/ice/tracers/tasks.hpp"
#include "components/ice/tracers/tracers.hpp"

// The tasks of tracers, for scenes that have any. `tracers` are either those of all gases, std::vector<Tracers>, or
// these as materials that follow bodies. The tasks need c.flow of all cells.

namespace tushar::ice {

/// Adds the task that finds c.flow of gases without bodies.
template <int D>
void scheduleFlow(TaskList& tasks) {
  tasks.perPatch("ice::findFlow", findFlow<D>, requiresNew(euler::c::density), requiresNew(euler::c::momentum<D>),
                 computes(c::flow<D>));
}

/// Adds the task that sets the velocities of new tracers: `atEnd` of a step, or at the start of a run.
template <int D, class Materials>
void scheduleVelocity(TaskList& tasks, const euler::Gas& gas, const Materials& tracers, bool atEnd) {
  const auto schedule = [&](auto dt) {
    tasks.perMaterial("ice::setTracerVelocity", setTracerVelocity<D>, tracers, with(gas), startTime(), dt,
                      withoutMaterial(requiresNew(c::flow<D>, flowReach)), requiresNew(p::x<D>),
                      modifies(p::velocity<D>));
  };
  if (atEnd)
    schedule(requiresOld(delT));
  else
    schedule(with(0.0));
}

/// Adds the tasks that make the tracers at the start.
template <int D, class Materials>
void scheduleStartOfTracers(TaskList& tasks, const TracersOfGases& all, const euler::Gas& gas,
                            const Materials& tracers) {
  tasks.newParticles("ice::placeTracers", placeTracers<D>, tracers, with(&all), startTime(),
                     tasks::all<NewTracers<D>>(&all.scalars()));
  scheduleVelocity<D>(tasks, gas, tracers, false);
  for (const auto& one : all.scalars())
    if (one->decays())
      tasks.perPatch("ice::initializeDecay", initializeDecay<D>, with(one->settings().decay),
                     computes(one->coefficientOfCells()));
}

/// Adds the tasks that move tracers, before they are relocated.
template <int D, class Materials>
void scheduleMotionOfTracers(TaskList& tasks, const TracersOfGases& all, const euler::Gas& gas,
                             const Materials& tracers) {
  tasks.perMaterial("ice::moveTracers", moveTracers<D>, tracers, with(gas), startTime(), requiresOld(delT),
                    withoutMaterial(requiresNew(c::flow<D>, flowReach)), tasks::all<MovingTracers<D>>());
  for (const auto& one : all.scalars())
    if (one->decays())
      tasks.perMaterial("ice::decayTracerScalar", decayTracerScalar<D>, tracers, with(one->settings().decay),
                        requiresOld(delT), withoutMaterial(requiresOld(one->coefficientOfCells(), 1)),
                        tasks::all<DecayingScalar<D>>(one.get()));
    else
      tasks.perMaterial("ice::keepTracerScalar", keepTracerScalar, tracers, requiresOld(one->value()),
                        computes(one->value()));
}

/// Adds the tasks that make tracers during a run, after others have been relocated.
template <int D, class Materials>
void scheduleNewTracers(TaskList& tasks, const TracersOfGases& all, const euler::Gas& gas, const Materials& tracers) {
  if (!all.hasSources()) return;
  tasks.newParticles("ice::insertTracers", insertTracers<D>, tracers, with(&all), startTime(), requiresOld(delT),
                     tasks::all<KnownTracers<D>>(&all.scalars()), tasks::all<NewTracers<D>>(&all.scalars()));
  scheduleVelocity<D>(tasks, gas, tracers, true);
}

/// Adds the tasks that make the tracers of gases without bodies at the start, unless there are none.
template <int D>
void scheduleStartAlone(TaskList& tasks, const TracersOfGases* all, const euler::Gas& gas) {
  if (!all) return;
  scheduleFlow<D>(tasks);
  scheduleStartOfTracers<D>(tasks, *all, gas, all->ofGases());
}
/// Adds the tasks of a step for the tracers of gases without bodies, unless there are none.
template <int D>
void scheduleStepAlone(TaskList& tasks, const TracersOfGases* all, const euler::Gas& gas) {
  if (!all) return;
  scheduleFlow<D>(tasks);
  scheduleMotionOfTracers<D>(tasks, *all, gas, all->ofGases());
  tasks.relocate(p::x<D>, all->ofGases());
  scheduleNewTracers<D>(tasks, *all, gas, all->ofGases());
}

/// Adds the diagnostics of tracers, after those of the gas.
template <int D, class Materials>
void scheduleDiagnosticsOfTracers(TaskList& tasks, const TracersOfGases& all, const Materials& tracers) {
  tasks.perMaterial("ice::countTracers", countTracers<D>, tracers, requiresOld(p::x<D>), computes(total::tracers));
  const auto show = [&](auto cells, const ParticleLabel<double>& label) {
    tasks.perMaterial("ice::cloneToTracers", cloneToTracers<D>, tracers, withoutMaterial(cells), requiresOld(p::x<D>),
                      computes(label));
  };
  for (const auto& one : all.clones())
    show(one->of().isOfState ? requiresOld(*one->of().label) : requiresNew(*one->of().label), one->label());
  for (const auto& one : all.scalars())
    if (one->decays()) show(requiresOld(one->coefficientOfCells()), one->coefficient());
}

/// The number of tracers at the end of the run, for the report.
inline simulation::Reported numberOfTracers() {
  return {"tracers", "tracers in the grid", "1", &total::tracers, simulation::Reported::Over::end};
}

}  // namespace tushar::ice
