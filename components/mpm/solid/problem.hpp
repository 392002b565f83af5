#pragma once

#include "components/mpm/solid/cohesive/zones.hpp"
#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/loads/inserted_particles.hpp"
#include "components/mpm/solid/loads/prescribed_deformation.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/surroundings.hpp"
#include "components/mpm/solid/tasks/create_particles.hpp"
#include "components/mpm/solid/tasks/show_state.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// The solids of a scene, and how they are computed.
struct Problem {
  Method method;
  std::vector<Material> materials;
  std::vector<Contact> contacts;
  Start start;
  /// Prescribed motion of all bodies; null: forces move them.
  std::shared_ptr<const PrescribedDeformation> motion = nullptr;
  std::vector<Insertion> insertions = {};                      ///< insertions of particles, in the order of the file
  std::vector<CohesiveZones> zones = {};                       ///< cohesive zones between the bodies
  std::shared_ptr<const Surroundings> surroundings = nullptr;  ///< surrounding medium; null: there is none
  std::vector<InputProblem> notes = {};                        ///< notes on bodies without particles
};

/// The base class of components for solids, with any shape functions and with explicit or implicit steps.
class Solids : public Component {
 public:
  /// Particles store at least `leastState` state variables for their model.
  explicit Solids(Problem problem, int leastState = 0)
      : problem_(std::move(problem)),
        state_size_(std::max(leastState, largestStateOf(problem_.materials))),
        state_views_(stateViews(problem_.materials)) {
    state_.setCount(state_size_);
  }
  const Problem& problem() const { return problem_; }
  std::vector<std::string> foreignLabels() const override;
  simulation::OtherNames otherNames() const override;
  std::vector<InputProblem> notes() const override { return problem_.notes; }
  /// Whether p.work is available.
  virtual bool measuresWork() const { return false; }

 protected:
  Problem problem_;
  int state_size_;  ///< largest number of state variables of any model
  ParticleLabel<double> state_{"p.modelState", "SI units", "internal variables of the constitutive model"};
  std::vector<std::shared_ptr<const StateView>> state_views_;
};

}  // namespace tushar::mpm::solid
