#pragma once

#include <memory>

#include "components/mpm/solid/problem.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// Shape functions of solids with explicit time steps, each in a separate module: `mpm_solid_gimp`, …
enum class Interpolator { linear, gimp, cpdi, quadratic, cubic };

/// Makes the method on a grid of 1, 2 or 3 dimensions.
using MakeSolids = std::unique_ptr<Solids> (*)(int dimension, const Problem& problem);

/// The factory of the method with these shape functions; loads their module.
MakeSolids solidsOf(Interpolator interpolator, bool isAxisymmetric);

/// The module of an interpolator calls this when it is loaded. `axisymmetric` is null if it has no such shape
/// functions.
void defineSolids(Interpolator interpolator, MakeSolids make, MakeSolids axisymmetric = nullptr);

}  // namespace tushar::mpm::solid
