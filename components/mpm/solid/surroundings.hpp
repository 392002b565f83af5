#pragma once

#include "components/mpm/solid/material.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// A medium that surrounds solids and acts on them, such as a gas: it adds its tasks to those of the solids.
class Surroundings {
 public:
  virtual ~Surroundings() = default;
  /// Whether the surroundings change p.temperature.
  virtual bool exchangesHeat() const { return false; }
  /// Adds tasks after the particles of `materials` have been created; `materials` must outlive the list.
  virtual void scheduleStart(TaskList& tasks, const std::vector<Material>& materials) const = 0;
  /// Adds tasks after g.record has velocities and masses, and before forces accelerate the nodes. The tasks compute
  /// g.surroundingForce. `state` contains the internal variables of the constitutive models.
  virtual void scheduleForces(TaskList& tasks, const std::vector<Material>& materials,
                              const ParticleLabel<double>& state) const = 0;
  /// Adds the tasks that run before particles are relocated, when p.x is known at the start and at the end of the step,
  /// and g.record contains the velocities at both times.
  virtual void scheduleMotion(TaskList& tasks, const std::vector<Material>& materials) const = 0;
  /// Adds the relocation of the particles of `materials`, and of particles of its own.
  virtual void scheduleRelocation(TaskList& tasks, const std::vector<Material>& materials) const = 0;
};

}  // namespace tushar::mpm::solid
