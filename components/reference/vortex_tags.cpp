#include "components/reference/vortex_tags.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tushar::reference {

MovingFrame frameOf(const VortexTags& tags, const grid::Level& level) {
  for (int d = 0; d < 3; ++d) {
    bool inGrid = d == tags.axis;
    for (int k = 0; k < level.dimension(); ++k) inGrid = inGrid || level.axis(k) == d;
    if (!inGrid)
      throw std::invalid_argument(
          fmt::format("axis: a vortex around {} needs a grid in {} and {}, but this one has no {}", "xyz"[tags.axis],
                      "yzx"[tags.axis], "zxy"[tags.axis], "xyz"[d]));
  }
  const grid::Domain& domain = level.domain();
  return {tags.centre, tags.velocity, tags.period.value_or(domain.upper - domain.lower)};
}

}  // namespace tushar::reference
