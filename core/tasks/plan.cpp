#include "core/tasks/plan.hpp"

#include <algorithm>
#include <map>

namespace tushar::tasks {

using data::Generation;

std::vector<Generation> particleSetsBefore(const std::vector<Task>& tasks) {
  std::vector<Generation> sets;
  Generation now = Generation::old;
  for (const Task& task : tasks) {
    sets.push_back(now);
    if (task.kind != TaskKind::work) now = Generation::fresh;
  }
  return sets;
}

namespace {

/// Ghosts that a task requires. Their values are complete after task `ready` (-1: from the start); task `reader` is the
/// first to read them.
struct Need {
  GhostFill fill;
  int ready;
  int reader;
};

class Needs {
 public:
  explicit Needs(const std::vector<Task>& tasks) : sets_(particleSetsBefore(tasks)) {
    for (std::size_t t = 0; t < tasks.size(); ++t) visit(static_cast<int>(t), tasks[t]);
  }
  const std::vector<Need>& all() const { return needs_; }

 private:
  void visit(int t, const Task& task) {
    const Generation set = sets_[t];
    for (const Access& access : task.accesses)
      if (access.reads() && access.ghost > 0) need(t, task, access, set);
    for (const Access& access : task.accesses)
      if (access.writes()) last_write_[std::string(access.label->name)] = t;
    for (const Access& access : task.accesses)
      if (access.kind == AccessKind::computes && access.label->centring == data::Centring::node)
        made_near_[std::string(access.label->name)] = set;
    if (task.kind != TaskKind::work) last_change_of_set_ = t;
  }

  void need(int t, const Task& task, const Access& access, Generation set) {
    const Generation generation = access.isNew() ? Generation::fresh : Generation::old;
    const auto written = last_write_.find(access.label->name);
    int ready = access.isNew() && written != last_write_.end() ? written->second : -1;
    if (access.isNew() && access.label->centring == data::Centring::particle)
      ready = std::max(ready, last_change_of_set_);
    const auto made = made_near_.find(access.label->name);
    const Generation near = access.isNew() && made != made_near_.end() ? made->second : set;
    const Need wanted{{access.label, generation, near, task.rangeOf(access)}, ready, t};
    const bool known = std::any_of(needs_.begin(), needs_.end(),
                                   [&](const Need& n) { return n.fill == wanted.fill && n.ready == wanted.ready; });
    if (!known) needs_.push_back(wanted);
  }

  std::vector<Generation> sets_;
  std::map<std::string, int, std::less<>> last_write_;
  /// Generation of the particle set from which each node variable was computed.
  std::map<std::string, Generation, std::less<>> made_near_;
  int last_change_of_set_ = -1;
  std::vector<Need> needs_;
};

}  // namespace

std::vector<Stage> plan(const std::vector<Task>& tasks) {
  std::vector<Stage> stages(tasks.size());
  std::vector<Need> open = Needs(tasks).all();
  std::stable_sort(open.begin(), open.end(), [](const Need& a, const Need& b) { return a.reader < b.reader; });
  while (!open.empty()) {
    const int at = open.front().reader;
    Stage& stage = stages[at];
    std::erase_if(open, [&](const Need& need) {
      if (need.ready >= at) return false;
      stage.fills.push_back(need.fill);
      stage.ready = std::max(stage.ready, need.ready);
      return true;
    });
  }
  return stages;
}

}  // namespace tushar::tasks
