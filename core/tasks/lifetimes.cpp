#include "core/tasks/lifetimes.hpp"

namespace tushar::tasks {

std::vector<std::vector<std::string>> lifetimes(const Pruned& pruned) {
  std::vector<std::vector<std::string>> freed(pruned.kept.size());
  Names held;
  for (std::size_t t = 0; t < pruned.kept.size(); ++t) {
    for (const Access& access : pruned.kept[t].accesses)
      if (access.writes() && access.label->centring != data::Centring::reduction) held.emplace(access.label->name);
    for (auto name = held.begin(); name != held.end();) {
      if (pruned.liveAfter[t].contains(*name)) {
        ++name;
        continue;
      }
      freed[t].push_back(*name);
      name = held.erase(name);
    }
  }
  return freed;
}

}  // namespace tushar::tasks
