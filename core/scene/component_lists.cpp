#include "core/scene/component_lists.hpp"

#include <algorithm>

namespace tushar::scene {

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
          for (std::vector<std::string>& materials = found[std::string(access.label->name)];
               const std::string& material : access.ofNone ? std::vector<std::string>() : task.materials)
            if (std::find(materials.begin(), materials.end(), material) == materials.end())
              materials.push_back(material);
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
