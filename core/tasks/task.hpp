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
  int ofMaterial = -1;  ///< index of the material, if it is always the same one; -1: that for which the task runs

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

/// Indices of consecutive materials, from `first` up to `end`; by default only -1, which stands for no material.
struct MaterialRange {
  int first = -1, end = 0;

  bool contains(int material) const { return first <= material && material < end; }
  bool overlaps(const MaterialRange& other) const { return first < other.end && other.first < end; }
  friend bool operator==(const MaterialRange&, const MaterialRange&) = default;
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
  int firstMaterial = 0;         ///< index of the first material for which it runs; it skips those before

  bool perMaterial() const { return !materials.empty(); }
  /// Whether an access refers to a separate variable for each material.
  bool perMaterial(const Access& access) const { return (perMaterial() && !access.ofNone) || access.ofMaterial >= 0; }
  /// The materials for which the task runs.
  MaterialRange range() const {
    return perMaterial() ? MaterialRange{firstMaterial, static_cast<int>(materials.size())} : MaterialRange{};
  }
  /// The materials to which the variables of an access belong.
  MaterialRange rangeOf(const Access& access) const {
    if (access.ofMaterial >= 0) return {access.ofMaterial, access.ofMaterial + 1};
    return perMaterial(access) ? range() : MaterialRange{};
  }
};

}  // namespace tushar::tasks
