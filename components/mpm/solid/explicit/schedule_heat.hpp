#pragma once

#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "components/mpm/solid/tasks/heat.hpp"

// The part of the schedule of SolidMpm that conducts heat.

namespace tushar::mpm::solid {

/// These tasks run only in scenes that read or save the temperature.
template <class Shape>
void SolidMpm<Shape>::scheduleHeat(TaskList& tasks) const {
  if (!problem_.method.conductsHeat) return;
  const auto& [materials, commonSize] = std::tie(problem_.materials, problem_.method.commonSize);
  const bool isHeated = problem_.start.loads.hasHeat(), hasContact = problem_.method.thermalContact;
  scheduleNodalTemperature<Shape>(tasks, materials, commonSize, keepsSizes());
  if (isHeated)
    tasks.perMaterial("mpm::applyHeatFlux", applyHeatFlux<D>, materials, with(problem_.start.loads), startTime(),
                      requiresOld(p::x<D>), requiresOld(p::loadCurves), computes(p::heatFlux));
  tasks.perMaterial("mpm::computeInternalHeatRate", computeInternalHeatRate<Shape>, materials, with(commonSize),
                    all<HeatFlow<Shape>>(keepsSizes(), isHeated));
  if (hasContact)
    tasks.acrossMaterials("mpm::computeHeatExchange", computeHeatExchange<D>, materials, requiresNew(g::heatCapacity),
                          requiresNew(g::temperature), requiresOld(delT), computes(g::contactTemperatureRate));
  tasks.perMaterial("mpm::integrateTemperatureRate", integrateTemperatureRate<D>, materials,
                    all<NodalHeating>(hasContact, rubbingHeats()), requiresOld(delT));
  scheduleTemperatureUpdate<Shape>(tasks, materials, commonSize, keepsSizes());
}

}  // namespace tushar::mpm::solid
