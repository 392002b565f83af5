#include "components/euler/flat_axes.hpp"

#include <fmt/format.h>

#include "components/euler/labels.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::euler {

std::vector<GivenVector> velocitiesAtSides(const input::Element& root) {
  std::vector<GivenVector> given;
  for (const input::Element& condition : simulation::boundaryConditions(root)) {
    const auto value = condition.child("value");
    if (!value || condition.attribute("label") != boundary::velocity.name ||
        condition.attribute("var") != nameOf(grid::BoundaryKind::dirichlet))
      continue;
    if (const auto vector = input::VectorExpression::parse(value->text()).value)
      given.push_back({value->where(), value->path(), *vector});
  }
  return given;
}

std::vector<GivenVector> velocitiesAtStart(const Settings& gas, const std::string& path) {
  std::vector<GivenVector> given;
  for (const GasObject& one : gas.objects) given.push_back({one.velocity.where(), path + "/velocity", one.velocity});
  return given;
}

void refuseAlongFlatAxes(const Level& level, const std::vector<GivenVector>& vectors) {
  std::vector<InputProblem> problems;
  for (int axis = 0; axis < 3; ++axis) {
    if (level.domain().resolution[axis] > 1 || level.domain().periodic[axis] == 0) continue;
    for (const GivenVector& one : vectors) {
      const input::Expression& along = one.value[axis];
      if (along.isConstant() && along(Vec3::Zero()) == 0) continue;
      problems.push_back({one.where, one.path,
                          fmt::format("has a component along {0}, along which the grid has one cell and is periodic: "
                                      "give it 2 cells along {0}, or set the component to 0",
                                      "xyz"[axis])});
    }
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace tushar::euler
