#pragma once

#include <span>
#include <vector>

#include "core/simulation/settings.hpp"
#include "core/tasks/marks.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::simulation {

/// A criterion with its variable, which is part of the state or one of the diagnostics.
struct BoundCriterion {
  Criterion criterion;
  const data::Label* label;
  bool isDiagnosed;
  /// Names of the materials that have the variable; empty if it does not belong to materials.
  std::vector<std::string> materials = {};
};

/// The materials for which tasks write a variable; empty if it does not belong to materials.
std::vector<std::string> materialsOf(const std::vector<tasks::Task>& tasks, const data::Label& label);

/// The values of a variable in a cell and in its two neighbours along an axis; null if there is no neighbour.
struct Neighbours {
  const double *below, *middle, *above;
};

/// The indicator of a cell from its neighbours along each axis, at distances `spacing` [m]; see Criterion::Indicator.
/// For vectors (several `components`), a jump is the magnitude of the vector jump, in its unit. Beyond the grid, the
/// cell's own value is used. Source of the second derivative: R. Löhner, Comput. Methods Appl. Mech. Eng. 61 (1987)
/// 323, with filter 0.01.
double indicatorOf(Criterion::Indicator indicator, std::span<const Neighbours> axes, std::span<const double> spacing,
                   int components);

/// The task that computes tasks::refinementMark from all criteria; the mark is 0 if there are none. All criteria with
/// materials must have the same materials.
tasks::Task markTask(std::vector<BoundCriterion> criteria);

}  // namespace tushar::simulation
