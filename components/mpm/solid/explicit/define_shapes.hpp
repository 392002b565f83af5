#pragma once

#include "components/mpm/solid/explicit/interpolators.hpp"

// For the modules of interpolators.

namespace tushar::mpm::solid {

template <class Shape>
inline constexpr ExplicitTasks<Shape::dimension> tasksOf = explicitTasks<Shape>();

/// Of shape functions in one to three dimensions.
template <template <int> class Shape>
constexpr TasksOfShapes shapesInSpace() {
  return {&tasksOf<Shape<1>>, &tasksOf<Shape<2>>, &tasksOf<Shape<3>>};
}
/// Of shape functions in radius and axis.
template <template <int> class Shape>
constexpr TasksOfShapes shapesAroundAxis() {
  return {&tasksOf<Shape<1>>, &tasksOf<Shape<2>>, nullptr};
}

}  // namespace tushar::mpm::solid
