#include <fmt/format.h>

#include <ostream>
#include <set>

#include "core/tasks/task_graph.hpp"

namespace tushar::tasks {

namespace {

std::string_view word(AccessKind kind) {
  switch (kind) {
    case AccessKind::requiresOld:
      return "requires old";
    case AccessKind::requiresNew:
      return "requires new";
    case AccessKind::computes:
      return "computes";
    case AccessKind::modifies:
      return "modifies";
    default:
      return "creates";
  }
}

void printAccesses(std::ostream& out, const Task& task, AccessKind kind) {
  std::string line;
  std::set<std::string_view> ofOthers;
  for (const Access& access : task.accesses) {
    const bool isOfOthers = access.ofMaterial >= 0;
    if (access.kind != kind || (isOfOthers && !ofOthers.insert(access.label->name).second)) continue;
    line += line.empty() ? "" : ", ";
    line += access.label->name;
    if (isOfOthers) line += " of other materials";
    if (access.ghost > 0) line += fmt::format(" (ghost {})", access.ghost);
  }
  if (!line.empty()) out << fmt::format("      {:<13} {}\n", word(kind), line);
}

}  // namespace

void TaskGraph::print(std::ostream& out) const {
  out << fmt::format("{}\n", name_);
  int number = 0;
  for (const CompiledTask& compiled : tasks_) {
    const Task& task = compiled.task;
    std::string materials;
    for (std::size_t m = task.firstMaterial; m < task.materials.size(); ++m)
      materials += (materials.empty() ? "" : ", ") + task.materials[m];
    out << fmt::format("  {:>2}  {}{}\n", ++number, task.name, materials.empty() ? "" : " [" + materials + "]");
    for (const AccessKind kind : {AccessKind::requiresOld, AccessKind::requiresNew, AccessKind::computes,
                                  AccessKind::modifies, AccessKind::creates})
      printAccesses(out, task, kind);
  }
}

void TaskGraph::printLeftOut(std::ostream& out) const {
  for (const LeftOut& task : leftOut()) out << fmt::format("  --  {} left out: {}\n", task.task, task.reason);
}

void TaskGraph::printDot(std::ostream& out) const {
  out << fmt::format("digraph \"{}\" {{\n  rankdir=LR; node [shape=box, style=rounded];\n", name_);
  for (std::size_t t = 0; t < tasks_.size(); ++t) out << fmt::format("  t{} [label=\"{}\"];\n", t, tasks_[t].task.name);
  for (const Dependency& d : dependencies_)
    out << fmt::format("  t{} -> t{} [label=\"{}\"];\n", d.before, d.after, d.label);
  out << "}\n";
}

}  // namespace tushar::tasks
