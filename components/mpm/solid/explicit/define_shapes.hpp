#pragma once

#include "components/mpm/solid/explicit/interpolators.hpp"

// The registration of shape functions by the modules of interpolators.

namespace tushar::mpm::solid {

template <class Shape>
inline constexpr ExplicitTasks<Shape::dimension> tasksOf = explicitTasks<Shape>();

/// The tasks for shape functions in one to three dimensions.
template <template <int> class Shape>
inline constexpr TasksOfShapes shapesInSpace{&tasksOf<Shape<1>>, &tasksOf<Shape<2>>, &tasksOf<Shape<3>>};
/// The tasks for shape functions in axisymmetric scenes, whose axes are the radius and the axis of symmetry.
template <template <int> class Shape>
inline constexpr TasksOfShapes shapesAroundAxis{&tasksOf<Shape<1>>, &tasksOf<Shape<2>>, nullptr};

}  // namespace tushar::mpm::solid
