#include "core/scene/component_lists.hpp"

#include <algorithm>

namespace tushar::scene {

namespace {

/// Adds the materials to which the variables of an access belong, if they are not in the list yet.
void addMaterials(const tasks::Task& task, const tasks::Access& access, std::vector<std::string>& materials) {
  const tasks::MaterialRange range = task.rangeOf(access);
  for (int m = std::max(range.first, 0); m < range.end; ++m)
    if (std::find(materials.begin(), materials.end(), task.materials[m]) == materials.end())
      materials.push_back(task.materials[m]);
}

}  // namespace

std::map<std::string, std::vector<std::string>> cellVariables(const simulation::Component& component) {
  tasks::TaskList initialize, advance, diagnose;
  component.scheduleInitialize(initialize);
  component.scheduleTimeAdvance(advance);
  component.scheduleDiagnostics(diagnose);
  std::map<std::string, std::vector<std::string>> found;
  for (const tasks::TaskList* list : {&initialize, &advance, &diagnose})
    for (const tasks::Task& task : list->tasks())
      for (const tasks::Access& access : task.accesses)
        if (access.writes() && access.label->centring == data::Centring::cell &&
            access.label->number == data::Number::real)
          addMaterials(task, access, found[std::string(access.label->name)]);
  return found;
}

bool hasParticles(const simulation::Component& component) {
  tasks::TaskList initialize;
  component.scheduleInitialize(initialize);
  return std::any_of(initialize.tasks().begin(), initialize.tasks().end(),
                     [](const tasks::Task& task) { return task.kind == tasks::TaskKind::newParticles; });
}

bool estimatesErrors(const simulation::Component& component) {
  tasks::TaskList estimate;
  component.scheduleErrorEstimate(estimate);
  return !estimate.tasks().empty();
}

}  // namespace tushar::scene
