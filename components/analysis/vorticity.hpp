#pragma once

#include "core/core.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `vorticity`: computes the curl of the gas velocity as a cell variable, `c.vorticity`, which can be saved, and which
/// other modules can sample. It corresponds to Uintah's `vorticity`.
simulation::AnalysisKind vorticityKind();

/// The curl of the gas velocity. It always has three components; some are 0 if the grid does not use all axes.
inline constexpr CellLabel<Vec3> vorticityLabel{"c.vorticity", "1/s", "vorticity, the curl of the velocity"};

/// Computes curl v by central differences, or by one-sided differences at a side of the grid. The velocity needs one
/// layer of ghosts. Derivatives and components along axes that the grid does not use are 0.
template <int D>
void computeVorticity(const Patch& patch, CellView<const Vec<D>> velocity, CellView<Vec3> vorticity);

}  // namespace tushar::analysis
