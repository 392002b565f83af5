#include "components/reference/module_tags.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tushar::reference {

const input::Schema<Region>& regionSchema() {
  static const input::Schema<Region> schema =
      input::Schema<Region>("within",
                            "Errors are measured only in this box (by default the whole grid): in cells whose centre "
                            "is inside, and at particles and nodes inside.")
          .required("min", &Region::lower, "m", "lower corner")
          .required("max", &Region::upper, "m", "upper corner")
          .check([](const Region& region, const input::Element& element, input::Diagnostics& diagnostics) {
            for (int axis = 0; axis < 3; ++axis)
              if (region.upper[axis] < region.lower[axis])
                diagnostics.error(element, fmt::format("max is below min along {}: {:g} < {:g} m", "xyz"[axis],
                                                       region.upper[axis], region.lower[axis]));
          });
  return schema;
}

Vec3 axesOf(const grid::Level& level) {
  Vec3 axes = Vec3::Zero();
  for (int k = 0; k < level.dimension(); ++k) axes[level.axis(k)] = 1;
  return axes;
}

MovingFrame frameOf(const VortexTags& tags, const grid::Level& level) {
  const Vec3 axes = axesOf(level);
  for (int d = 0; d < 3; ++d)
    if (d != tags.axis && axes[d] == 0)
      throw std::invalid_argument(
          fmt::format("axis: a vortex around {} needs a grid in {} and {}, but this grid does not use {}",
                      "xyz"[tags.axis], "yzx"[tags.axis], "zxy"[tags.axis], "xyz"[d]));
  MovingFrame frame{tags.centre, tags.velocity};
  const grid::Domain& domain = level.domain();
  for (int d = 0; d < 3; ++d)
    if (domain.periodic[d] != 0) frame.periods[d] = domain.upper[d] - domain.lower[d];
  return frame;
}

}  // namespace tushar::reference
