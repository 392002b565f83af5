#include "core/scene/module_conflicts.hpp"

#include <fmt/format.h>

#include <map>

#include "core/output/archive_globals.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::scene {

using input::Element;
using simulation::Analysis;

namespace {

[[noreturn]] void refuse(const Element& module, const std::string& sentence) {
  throw InputError({{module.where(), module.path(), sentence}});
}

bool isGlobal(const std::string& label) { return label.size() < 2 || label[1] != '.'; }

}  // namespace

void refuseTwice(const Analysis& analysis, const Element& module, TakenByModules& taken) {
  for (const report::MeasuredError& error : analysis.errors())
    if (const std::string what = error.field + ", " + error.place; !taken.measured.insert(what).second)
      refuse(module, fmt::format("a module above already measures the errors of '{}'; keep one", what));
  if (!analysis.energies().empty() && !taken.measured.insert("energies").second)
    refuse(module, "a module above already has the energy budget; keep one");
  tasks::TaskList tasks;
  analysis.schedule(tasks);
  std::set<std::string> computed;
  for (const tasks::Task& task : tasks.tasks())
    for (const tasks::Access& access : task.accesses)
      if (access.kind == tasks::AccessKind::computes) computed.emplace(access.label->name);
  for (const std::string& name : computed)
    if (!taken.computed.insert(name).second)
      refuse(module, fmt::format("a module above already computes '{}'; keep one", name));
}

void refuseSharedFiles(const std::vector<std::unique_ptr<Analysis>>& analyses,
                       const std::vector<simulation::SaveRequest>& saves, input::Diagnostics& diagnostics) {
  std::map<std::string, std::string> taken;  // the file, and its purpose
  for (const simulation::SaveRequest& save : saves)
    if (isGlobal(save.label))
      taken.emplace(output::GlobalFiles::nameOf(save.label), fmt::format("the saved '{}'", save.label));
  for (const auto& analysis : analyses)
    for (const simulation::OwnFile& file : analysis->files()) {
      const auto [other, isFree] = taken.emplace(file.path, fmt::format("the tag at {}", file.where.text()));
      if (!isFree)
        diagnostics.error(
            file.where, "DataAnalysis/Module",
            fmt::format("would overwrite '{}' of the archive, which {} needs; keep one, or choose another name",
                        file.path, other->second));
    }
}

}  // namespace tushar::scene
