#pragma once

#include "core/core.hpp"

namespace tushar::ice::c {

/// Variables of each of several gases, derived if a scene saves them.
inline constexpr CellLabel<double> ownDensity{"c.ownDensity", "kg/m^3",
                                              "mass of a gas over the volume that it has; 0 where it has none"};

}  // namespace tushar::ice::c
