#include "components/analysis/gas_fields.hpp"

#include <algorithm>

#include "core/input/schema.hpp"

namespace tushar::analysis {

using simulation::Component;
using tasks::TaskList;

namespace {

bool computesInCells(const TaskList& list, std::string_view label) {
  for (const tasks::Task& task : list.tasks())
    for (const tasks::Access& access : task.accesses)
      if (access.writes() && access.label->name == label && access.label->centring == data::Centring::cell &&
          !task.perMaterial(access))
        return true;
  return false;
}

/// The velocity that the scene gives along an axis on a part of a side of the grid [m/s]: 0 at a symmetry plane; none
/// if the scene gives none, or a formula.
std::optional<double> velocityGiven(const Level& level, int axis, int side, int material, int part) {
  constexpr BoundaryLabel<Vec3> velocity{"Velocity"};
  if (level.isSymmetry(axis, side, material, part)) return 0;
  const auto given = level.boundary(axis, side, velocity, material, part);
  const bool isNumber = given && given->isDirichlet() && !given->formula;
  return isNumber ? std::optional(given->value[level.axis(axis)]) : std::nullopt;
}

}  // namespace

VelocityAtEnd::VelocityAtEnd(const Level& level, int axis, int side, int material)
    : rest_(velocityGiven(level, axis, side, material, grid::restOfSide)) {
  for (int part = 0; part < std::ssize(level.parts(axis, side)); ++part)
    parts_.push_back(velocityGiven(level, axis, side, material, part));
}

std::optional<bool> isDerived(const Component& component, std::string_view label) {
  TaskList state, derived;
  component.scheduleInitialize(state);
  component.scheduleDiagnostics(derived);
  if (computesInCells(state, label)) return false;
  return computesInCells(derived, label) ? std::optional(true) : std::nullopt;
}

bool computesTotal(const Component& component, std::string_view label) {
  TaskList derived;
  component.scheduleDiagnostics(derived);
  for (const tasks::Task& task : derived.tasks())
    for (const tasks::Access& access : task.accesses)
      if (access.writes() && access.label->name == label) return true;
  return false;
}

int bodiesOf(const Component& component) {
  TaskList state;
  component.scheduleInitialize(state);
  std::size_t bodies = 0;
  for (const tasks::Task& task : state.tasks()) bodies = std::max(bodies, task.materials.size());
  return static_cast<int>(bodies);
}

void checkGas(const std::string& material, const Component& component, const input::Element& module) {
  const std::vector<std::string> gases = component.gasNames();
  if (gases.size() == 1 && bodiesOf(component) == 0) return;
  if (material.empty() || std::find(gases.begin(), gases.end(), material) != gases.end()) return;
  const std::string problem = gases.empty()
                                  ? "in this component, the velocity in cells belongs to no material; remove <material>"
                                  : input::choiceProblem(material, gases);
  const auto tag = module.child("material");
  throw InputError({{(tag ? *tag : module).where(), "DataAnalysis/Module/material", problem}});
}

}  // namespace tushar::analysis
