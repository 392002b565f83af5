#pragma once

#include <string>
#include <vector>

#include "core/data/label.hpp"
#include "core/tasks/task_body.hpp"

namespace tushar::tasks {

/// The ways in which a task uses a variable.
enum class AccessKind {
  requiresOld,  ///< reads the state at the start of the step
  requiresNew,  ///< reads values computed by an earlier task of the list
  computes,     ///< writes every value
  modifies,     ///< changes values computed by an earlier task
  creates,      ///< writes the values of new particles made by the same task
  leftOut,      ///< an offered output that nothing reads: it is not allocated
};

/// One declared use of a variable.
struct Access {
  const data::Label* label;
  AccessKind kind;
  int ghost = 0;                       ///< number of layers of cells or nodes read around the patch
  bool own = false;                    ///< for nodes: whether it writes only the nodes that the patch owns
  bool offered = false;                ///< whether the task is kept, without this access, if nothing reads the variable
  const data::Label* keeps = nullptr;  ///< for fluxes: the conserved variable
  /// Whether the variable does not belong to a material, although the task runs over materials.
  bool ofNone = false;

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
  std::vector<std::string> materials;  ///< names of the materials; empty for a task that does not run over materials
  std::vector<Access> accesses;
  TaskBody body;
  bool acrossMaterials = false;  ///< whether the body gets all materials of a patch together
  bool perRank = false;          ///< whether the body gets all patches of the rank together

  bool perMaterial() const { return !materials.empty(); }
  /// Whether an access refers to a separate variable for each material.
  bool perMaterial(const Access& access) const { return perMaterial() && !access.ofNone; }
};

}  // namespace tushar::tasks
