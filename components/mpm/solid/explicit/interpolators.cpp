#include "components/mpm/solid/explicit/interpolators.hpp"

#include <array>

#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "core/simulation/module.hpp"

namespace tushar::mpm::solid {

namespace {

constexpr std::array modules{"mpm_solid_linear", "mpm_solid_gimp", "mpm_solid_cpdi", "mpm_solid_quadratic",
                             "mpm_solid_cubic"};

struct Shapes {
  TasksOfShapes plain, axisymmetric;
};
std::array<Shapes, modules.size()>& shapesOfModules() {
  static std::array<Shapes, modules.size()> shapes;
  return shapes;
}

}  // namespace

std::unique_ptr<Solids> makeSolids(Interpolator interpolator, int dimension, const Problem& problem) {
  const auto place = static_cast<std::size_t>(interpolator);
  simulation::loadModule(modules[place]);
  const Shapes& shapes = shapesOfModules()[place];
  const TasksOfShapes& tasks = problem.start.axisymmetric ? shapes.axisymmetric : shapes.plain;
  if (dimension == 1) return std::make_unique<SolidMpm<1>>(problem, *tasks.line);
  if (dimension == 2) return std::make_unique<SolidMpm<2>>(problem, *tasks.plane);
  return std::make_unique<SolidMpm<3>>(problem, *tasks.space);
}

void defineShapes(Interpolator interpolator, const TasksOfShapes& shapes, const TasksOfShapes& axisymmetric) {
  shapesOfModules()[static_cast<std::size_t>(interpolator)] = {shapes, axisymmetric};
}

}  // namespace tushar::mpm::solid
