#pragma once

#include <memory>

#include "components/mpm/solid/explicit/explicit_tasks.hpp"
#include "components/mpm/solid/problem.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// Shape functions of solids with explicit time steps, each in a separate module: `mpm_solid_gimp`, …
enum class Interpolator { linear, gimp, cpdi, quadratic, cubic };

/// The tasks for shape functions in one to three dimensions, or in axisymmetric scenes; null for combinations that do
/// not exist.
struct TasksOfShapes {
  const ExplicitTasks<1>* line = nullptr;
  const ExplicitTasks<2>* plane = nullptr;
  const ExplicitTasks<3>* space = nullptr;
};

/// Constructs the method with these shape functions on a grid of a given dimension; loads their module.
std::unique_ptr<Solids> makeSolids(Interpolator interpolator, int dimension, const Problem& problem);

/// Registers shape functions. The module of the interpolator calls this function when it is loaded.
void defineShapes(Interpolator interpolator, const TasksOfShapes& shapes, const TasksOfShapes& axisymmetric = {});

}  // namespace tushar::mpm::solid
