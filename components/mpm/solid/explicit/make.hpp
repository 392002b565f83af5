#pragma once

#include "components/mpm/solid/explicit/interpolators.hpp"
#include "components/mpm/solid/explicit/schedule.hpp"

namespace tushar::mpm::solid {

/// A MakeSolids of shape functions in 1 to 3 dimensions.
template <template <int> class Shape>
std::unique_ptr<Solids> makeSolids(int dimension, const Problem& problem) {
  if (dimension == 1) return std::make_unique<SolidMpm<Shape<1>>>(problem);
  if (dimension == 2) return std::make_unique<SolidMpm<Shape<2>>>(problem);
  return std::make_unique<SolidMpm<Shape<3>>>(problem);
}

/// A MakeSolids of shape functions in radius and axis.
template <template <int> class Shape>
std::unique_ptr<Solids> makeAxisymmetricSolids(int dimension, const Problem& problem) {
  if (dimension == 1) return std::make_unique<SolidMpm<Shape<1>>>(problem);
  return std::make_unique<SolidMpm<Shape<2>>>(problem);
}

}  // namespace tushar::mpm::solid
