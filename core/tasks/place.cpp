#include "core/tasks/place.hpp"

namespace tushar::tasks {

std::vector<Placement> place(const std::vector<Task>& tasks, const grid::Grid& grid) {
  std::vector<Placement> placements;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    if (tasks[t].perRank) {
      placements.push_back({static_cast<int>(t), -1, -1});
      continue;
    }
    const int first = tasks[t].range().first;
    const int last = tasks[t].perMaterial() ? static_cast<int>(tasks[t].materials.size()) : 0;
    for (int material = first; material < last; ++material)
      for (const grid::Patch& patch : grid.patches()) placements.push_back({static_cast<int>(t), patch.id(), material});
  }
  return placements;
}

}  // namespace tushar::tasks
