#pragma once

#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "components/mpm/solid/tasks/heat.hpp"

// What heat adds to the schedule of SolidMpm.

namespace tushar::mpm::solid {

/// Only run where someone reads or saves the temperature.
template <class Shape>
void SolidMpm<Shape>::scheduleHeat(TaskList& tasks) const {
  if (!problem_.method.conductsHeat) return;
  const int reach = Shape::reach;
  const bool touching = problem_.method.thermalContact;
  tasks.perMaterial("mpm::interpolateTemperatureToGrid", interpolateTemperatureToGrid<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>, reach),
                    when(keepsSizes(), requiresOld(p::size<D>, reach)), requiresOld(p::deformationMeasure, reach),
                    requiresOld(p::mass, reach), requiresOld(p::temperature, reach), computes(g::heatCapacity),
                    computes(g::temperatureNoBC), computes(g::temperature));
  const bool heated = problem_.start.loads.hasHeat();
  if (heated)
    tasks.perMaterial("mpm::applyHeatFlux", applyHeatFlux<D>, problem_.materials, with(problem_.start.loads),
                      startTime(), requiresOld(p::x<D>), requiresOld(p::loadCurves), computes(p::heatFlux));
  tasks.perMaterial("mpm::computeInternalHeatRate", computeInternalHeatRate<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>, reach),
                    when(keepsSizes(), requiresOld(p::size<D>, reach)), requiresOld(p::deformationMeasure, reach),
                    requiresOld(p::mass, reach), when(heated, requiresNew(p::heatFlux, reach)),
                    requiresNew(g::temperature, reach + Shape::ghostNodes), computes(g::heatRate));
  if (touching)
    tasks.acrossMaterials("mpm::computeHeatExchange", computeHeatExchange<D>, problem_.materials,
                          requiresNew(g::heatCapacity), requiresNew(g::temperature), requiresOld(delT),
                          computes(g::contactTemperatureRate));
  tasks.perMaterial("mpm::integrateTemperatureRate", integrateTemperatureRate<D>, problem_.materials,
                    requiresNew(g::heatCapacity), requiresNew(g::temperatureNoBC), requiresNew(g::temperature),
                    requiresNew(g::heatRate), when(touching, requiresNew(g::contactTemperatureRate)),
                    when(rubbingHeats(), requiresNew(g::frictionHeat)), requiresOld(delT),
                    computes(g::temperatureRate));
  tasks.perMaterial("mpm::updateTemperature", updateTemperature<Shape>, problem_.materials,
                    with(problem_.method.commonSize), requiresOld(p::x<D>), when(keepsSizes(), requiresOld(p::size<D>)),
                    requiresOld(p::deformationMeasure), requiresOld(p::temperature),
                    requiresNew(g::temperatureRate, Shape::ghostNodes), requiresOld(delT), computes(p::temperature));
}

/// The heat of a step's work, once conduction has had its share.
template <class Shape>
void SolidMpm<Shape>::scheduleHeating(TaskList& tasks) const {
  if (heats_ && problem_.method.conductsHeat)
    tasks.perMaterial("mpm::finalParticleUpdate", addWorkOfStep, problem_.materials, requiresNew(p::temperatureChange),
                      modifies(p::temperature));
  else if (heats_)
    tasks.perMaterial("mpm::finalParticleUpdate", heatByWorkOfStep, problem_.materials,
                      requiresNew(p::temperatureChange), requiresOld(p::temperature), computes(p::temperature));
}

}  // namespace tushar::mpm::solid
