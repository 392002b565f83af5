#include "components/mpm/solid/tasks/heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "components/mpm/boundary_labels.hpp"
#include "core/base/error.hpp"
#include "core/grid/nodes_of_sides.hpp"

namespace tushar::mpm::solid {

void forEachGivenTemperature(const Patch& patch, int material, FunctionRef<void(const Box&, double)> visit) {
  for (int d = 0; d < patch.level().dimension(); ++d)
    for (const int side : {0, 1}) {
      if (!grid::mayTouchSide(patch, d, side)) continue;
      const auto given = patch.level().boundary(d, side, boundary::temperature, material);
      if (!given || !given->isDirichlet()) continue;
      grid::forEachBoxOnSide(patch, d, side, [&](const Box& nodes) { visit(nodes, given->value); });
      grid::forEachBoxBeyond(patch, d, side, [&](const Box& nodes, int) { visit(nodes, given->value); });
    }
}

void checkHeatStep(const Level& level, const Material& material, double dt) {
  double h = std::numeric_limits<double>::infinity();
  for (int d = 0; d < level.dimension(); ++d) h = std::min(h, level.spacing(d));
  const double longest = material.density * material.specificHeat * h * h / (2 * material.thermalConductivity);
  if (material.thermalConductivity > 0 && dt > longest)
    throw NumericalError(
        fmt::format("a step of {:.4g} s is too long for the heat conduction of '{}', which is stable up to {:.4g} s",
                    dt, material.name, longest),
        fmt::format("a delt_max of {:.3g} s, or DoExplicitHeatConduction false", 0.9 * longest));
}

}  // namespace tushar::mpm::solid
