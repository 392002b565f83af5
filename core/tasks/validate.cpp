#include "core/tasks/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/error.hpp"

namespace tushar::tasks {

namespace {

class Validator {
 public:
  Validator(const std::vector<Task>& tasks, const Names& state) : state_(state) {
    for (const Task& task : tasks) check(task);
  }
  const std::string& complaints() const { return complaints_; }

 private:
  void check(const Task& task) {
    if (task.kind != TaskKind::work) carried_.emplace(data::particleId.name);
    if (task.kind == TaskKind::relocate)
      for (const std::string& name : state_)
        if (name.starts_with("p.")) carried_.insert(name);
    for (const Access& access : task.accesses) {
      checkMaterial(task, access);
      if (access.reads()) checkProducer(task, access);
    }
    for (const Access& access : task.accesses)
      if (access.writes()) checkWriter(task, access);
    for (const Access& access : task.accesses)
      if (isGhostsOfParticles(access)) checkStandsStill(task, access);
  }

  void checkMaterial(const Task& task, const Access& access) {
    if (access.label->centring == data::Centring::reduction) return;
    const auto [entry, added] = per_material_.try_emplace(std::string(access.label->name), task.perMaterial(access));
    if (entry->second != task.perMaterial(access))
      complain(task, access, "is used both with and without a material; use two labels");
    if (access.ofNone && access.writes() && !task.acrossMaterials)
      complain(task, access, "is written once for each material, but belongs to none; use acrossMaterials");
    if (access.ofMaterial >= 0 && access.writes())
      complain(task, access, "belongs to other materials than those of the task, which may only read it");
  }

  void checkProducer(const Task& task, const Access& access) {
    const Names& available = access.isNew() ? produced_ : state_;
    if (available.contains(access.label->name)) return;
    if (access.isNew() && carried_.contains(access.label->name)) return;
    if (access.isNew())
      complain(task, access, "is required, but no earlier task of the list computes it" + nearest(access, available));
    else
      complain(task, access,
               "is required at the start of the step, but no task of scheduleInitialize computes it" +
                   nearest(access, available));
  }

  void checkWriter(const Task& task, const Access& access) {
    produced_.insert(std::string(access.label->name));
    std::vector<MaterialRange>& written = written_[std::string(access.label->name)];
    const MaterialRange range = task.rangeOf(access);
    const bool isAgain = std::any_of(written.begin(), written.end(), [&](const MaterialRange& other) {
      return range.first < 0 || other.first < 0 || range.overlaps(other);
    });
    const bool adds = access.label->centring == data::Centring::reduction || access.keeps;
    if (isAgain && !adds && access.kind == AccessKind::computes)
      complain(task, access, "is computed a second time; use modifies to change it");
    written.push_back(range);
  }

  /// Whether an access reads ghosts of particles in place: the patches of a rank read one another's particles directly,
  /// except for new particles, which are installed only when all patches have made theirs.
  static bool isGhostsOfParticles(const Access& access) {
    return access.kind == AccessKind::requiresNew && access.ghost > 0 &&
           access.label->centring == data::Centring::particle;
  }
  void checkStandsStill(const Task& task, const Access& access) {
    const bool writes = std::any_of(task.accesses.begin(), task.accesses.end(), [&](const Access& other) {
      return other.kind == AccessKind::modifies && other.label->name == access.label->name;
    });
    if (writes)
      complain(task, access, "is read outside the patch and written by the same task; write to another label");
  }

  static std::string nearest(const Access& access, const Names& available) {
    return didYouMean(access.label->name, {available.begin(), available.end()});
  }

  void complain(const Task& task, const Access& access, const std::string& what) {
    if (!complaints_.empty()) complaints_ += '\n';
    complaints_ += fmt::format("task {}: {} {}", task.name, access.label->name, what);
  }

  const Names& state_;
  Names produced_;
  std::map<std::string, std::vector<MaterialRange>> written_;  ///< the materials of the writers of each variable
  Names carried_;  ///< names of variables that a relocation transferred from the old state
  std::map<std::string, bool> per_material_;
  std::string complaints_;
};

}  // namespace

Names producedBy(const std::vector<Task>& tasks) {
  Names names;
  for (const Task& task : tasks) {
    for (const Access& access : task.accesses)
      if (access.writes()) names.emplace(access.label->name);
    if (task.kind == TaskKind::newParticles) names.emplace(data::particleId.name);
  }
  return names;
}

void validate(const std::vector<Task>& tasks, const Names& state) {
  const Validator validator(tasks, state);
  if (!validator.complaints().empty()) throw TaskError(validator.complaints());
}

}  // namespace tushar::tasks
