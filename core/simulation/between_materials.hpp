#pragma once

#include "core/data/label.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::simulation {

/// The index of the material to which a particle belongs from the next step on.
inline constexpr data::ParticleLabel<int> nextMaterial{"p.nextMaterial", "1",
                                                       "index of the material of the particle from the next step on"};

/// An interface for components that move particles from one material to another between steps, such as grains that
/// separate. Materials may then have no particles: tasks skip those that have none on any rank, and their node and cell
/// variables have no values.
class MovesBetweenMaterials {
 public:
  virtual ~MovesBetweenMaterials() = default;

  /// Adds tasks that compute `nextMaterial` of all particles from the state at the end of a step, which is old by then;
  /// none if particles of this scene keep their material. Materials that exchange particles must have variables of the
  /// same labels.
  virtual void scheduleNextMaterials(tasks::TaskList& tasks) const = 0;
};

}  // namespace tushar::simulation
