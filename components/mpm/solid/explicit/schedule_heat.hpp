#pragma once

#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/tasks/heat.hpp"

// The part of the schedule of SolidMpm that conducts heat.

namespace tushar::mpm::solid {

/// These tasks run only in scenes that read or save the temperature.
template <class Shape>
void SolidMpm<Shape>::scheduleHeat(TaskList& tasks) const {
  if (!problem_.method.conductsHeat) return;
  const auto& [materials, commonSize] = std::tie(problem_.materials, problem_.method.commonSize);
  scheduleNodalTemperature<Shape>(tasks, materials, commonSize, keepsSizes());
  scheduleHeatFlux(tasks);
  tasks.perMaterial("mpm::computeInternalHeatRate", computeInternalHeatRate<Shape>, materials, with(commonSize),
                    all<HeatFlow<Shape>>(keepsSizes(), problem_.start.loads.hasHeat()));
  scheduleTemperatureRate(tasks);
  scheduleTemperatureUpdate<Shape>(tasks, materials, commonSize, keepsSizes());
}

}  // namespace tushar::mpm::solid
