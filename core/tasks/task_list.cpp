#include "core/tasks/task_list.hpp"

namespace tushar::tasks {

int append(std::vector<Access>& accesses, const Access& access) {
  accesses.push_back(access);
  return static_cast<int>(accesses.size()) - 1;
}

const data::ParticleSet& noParticles() {
  static const data::ParticleSet none;
  return none;
}

void TaskList::add(Task task) { tasks_.push_back(std::move(task)); }

void TaskList::add(std::string_view name, TaskKind kind, std::vector<std::string>&& materials,
                   std::vector<Access>&& accesses, TaskBody&& body, Sees sees) {
  add({std::string(name), kind, std::move(materials), std::move(accesses), std::move(body), sees == Sees::allMaterials,
       sees == Sees::rank});
}

}  // namespace tushar::tasks
