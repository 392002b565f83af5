#pragma once

#include <string>

#include "core/tasks/task_list.hpp"

namespace tushar::simulation {

/// An interface for components that have a second way to take a step, which is more robust but costs more, or agrees
/// less with other programs. A run takes its steps in this way from the first step after a particle had to be removed
/// (data::removed) on. As checkpoints store the number of removed particles, a restart continues in the same way.
class CarefulSteps {
 public:
  virtual ~CarefulSteps() = default;

  /// Adds the tasks of one step, as Component::scheduleTimeAdvance does, from the same old state to the same new state;
  /// none if the scene has no second way.
  virtual void scheduleCarefulTimeAdvance(tasks::TaskList& tasks) const = 0;
  /// What these steps do differently; continues a sentence after `from now on`.
  virtual std::string aboutCarefulSteps() const = 0;
};

}  // namespace tushar::simulation
