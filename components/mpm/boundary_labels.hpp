#pragma once

#include "core/grid/boundary.hpp"

namespace tushar::mpm::boundary {

/// Labels of the values that a side of the grid prescribes for a material.
inline constexpr grid::BoundaryLabel<Vec3> velocity{"Velocity"};
inline constexpr grid::BoundaryLabel<double> temperature{"Temperature"};

}  // namespace tushar::mpm::boundary
