#pragma once

#include <string>
#include <vector>

#include "core/data/label.hpp"
#include "core/tasks/task_body.hpp"

namespace tushar::tasks {

/// The ways in which a task uses a variable.
enum class AccessKind {
  requiresOld,  ///< reads the state at the start of the step
  requiresNew,  ///< reads what an earlier task of the list computed
  computes,     ///< writes every value
  modifies,     ///< changes what an earlier task computed
  creates,      ///< writes the values of particles that the task itself makes
  leftOut,      ///< an offered output that nothing reads: not allocated
};

/// One declared use of a variable.
struct Access {
  const data::Label* label;
  AccessKind kind;
  int ghost = 0;                       ///< number of layers of cells or nodes read around the patch
  bool own = false;                    ///< for nodes: whether it writes only those that the patch owns
  bool offered = false;                ///< whether a kept task can run without it
  const data::Label* keeps = nullptr;  ///< for fluxes: the conserved variable
  bool ofNone = false;                 ///< whether the variable belongs to no material, although the task does

  bool reads() const {
    return kind == AccessKind::requiresOld || kind == AccessKind::requiresNew || kind == AccessKind::modifies;
  }
  bool writes() const {
    return kind == AccessKind::computes || kind == AccessKind::modifies || kind == AccessKind::creates;
  }
  bool isNew() const { return kind != AccessKind::requiresOld; }
};

/// Appends an access of a task; returns its index.
int append(std::vector<Access>& accesses, const Access& access);

enum class TaskKind {
  work,          ///< runs a body
  relocate,      ///< a built-in task: assigns particles to their new patches and cells
  newParticles,  ///< runs a body that replaces the particles of its patch with others
};

/// A task as a component declares it, before it is placed on patches.
struct Task {
  std::string name;
  TaskKind kind = TaskKind::work;
  std::vector<std::string> materials;  ///< names; empty for a task that belongs to no material
  std::vector<Access> accesses;
  TaskBody body;
  bool acrossMaterials = false;  ///< the body gets all materials of a patch at once
  bool perRank = false;          ///< the body gets all patches of the rank at once

  bool perMaterial() const { return !materials.empty(); }
  /// Whether each material has its own variable for an access.
  bool perMaterial(const Access& access) const { return perMaterial() && !access.ofNone; }
};

}  // namespace tushar::tasks
