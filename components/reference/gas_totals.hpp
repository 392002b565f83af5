#pragma once

#include "core/core.hpp"
#include "core/simulation/conserved.hpp"

/// Totals of a gas. All gas methods use these labels, so that studies can compare the methods.
namespace tushar::reference::total {

inline constexpr ReductionLabel<Minimum> leastDensity{"LeastDensity", "kg/m^3", "smallest density in the gas"};
inline constexpr ReductionLabel<Minimum> leastEnergy{"LeastInternalEnergy", "J/kg",
                                                     "smallest internal energy in the gas"};
inline constexpr ReductionLabel<Sum> entropy{"TotalEntropy", "kg",
                                             "entropy of the gas divided by c_v, up to a constant"};

}  // namespace tushar::reference::total
