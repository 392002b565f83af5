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
  MovingFrame frame{tags.centre, tags.velocity};
  const grid::Domain& domain = level.domain();
  for (int d = 0; d < 3; ++d)
    if (domain.periodic[d] != 0) frame.periods[d] = domain.upper[d] - domain.lower[d];
  return frame;
}

}  // namespace tushar::reference
