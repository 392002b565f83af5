#include "core/tasks/connect.hpp"

#include <map>
#include <set>

namespace tushar::tasks {

namespace {

struct Usage {
  int lastWriter = -1;
  std::set<int> readersSince;
};

class Connector {
 public:
  void visit(int task, const Task& declared) {
    if (declared.kind != TaskKind::work) touchAllParticles(task);
    for (const Access& access : declared.accesses)
      if (access.isNew() && access.reads()) read(task, std::string(access.label->name));
    for (const Access& access : declared.accesses)
      if (access.writes()) write(task, std::string(access.label->name));
  }
  std::vector<Dependency> take() { return std::move(dependencies_); }

 private:
  /// Records that a task moves all particle variables because it changes the particle set.
  void touchAllParticles(int task) {
    for (auto& [label, usage] : usages_)
      if (label.starts_with("p.")) write(task, label);
    last_change_of_set_ = task;
  }
  void read(int task, const std::string& label) {
    Usage& usage = usages_[label];
    if (usage.lastWriter < 0 && label.starts_with("p.")) usage.lastWriter = last_change_of_set_;
    if (usage.lastWriter >= 0 && usage.lastWriter != task) link(usage.lastWriter, task, label);
    usage.readersSince.insert(task);
  }
  void write(int task, const std::string& label) {
    Usage& usage = usages_[label];
    if (usage.lastWriter >= 0 && usage.lastWriter != task) link(usage.lastWriter, task, label);
    for (int reader : usage.readersSince)
      if (reader != task) link(reader, task, label);
    usage = {task, {}};
  }
  void link(int before, int after, const std::string& label) {
    const Dependency dependency{before, after, label};
    // Tasks come in order, so those of the same task are the last ones.
    for (auto known = dependencies_.rbegin(); known != dependencies_.rend() && known->after == after; ++known)
      if (*known == dependency) return;
    dependencies_.push_back(dependency);
  }

  std::map<std::string, Usage> usages_;
  std::vector<Dependency> dependencies_;
  int last_change_of_set_ = -1;
};

}  // namespace

std::vector<Dependency> connect(const std::vector<Task>& tasks) {
  Connector connector;
  for (std::size_t t = 0; t < tasks.size(); ++t) connector.visit(static_cast<int>(t), tasks[t]);
  return connector.take();
}

}  // namespace tushar::tasks
