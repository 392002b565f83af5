#pragma once

#include "core/grid/boundary.hpp"

namespace tushar::mpm::boundary {

/// What a material keeps at a side of the grid.
inline constexpr grid::BoundaryLabel<Vec3> velocity{"Velocity"};
inline constexpr grid::BoundaryLabel<double> temperature{"Temperature"};

}  // namespace tushar::mpm::boundary
