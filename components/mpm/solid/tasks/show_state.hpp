#pragma once

#include <memory>
#include <set>

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// Copies a state variable from those that each particle stores for its model; 0 if the model does not have it.
template <class T>
void showState(const Patch&, const Material& material, std::string_view name, int stateSize,
               ParticleView<const double> state, ParticleView<T> values) {
  const int offset = offsetOf(*material.model, name);
  const double* const numbers = values.owned() > 0 ? &state[0] : nullptr;
  for (int p = 0; p < values.owned(); ++p) {
    const double* const own = numbers + p * stateSize + offset;
    if constexpr (std::is_same_v<T, double>)
      values[p] = offset < 0 ? 0.0 : *own;
    else
      values[p] = offset < 0 ? T(T::Zero()) : T(Eigen::Map<const T>(own));
  }
}

/// A state variable of constitutive models as a separate label, computed only if a scene saves it.
class StateView {
 public:
  virtual ~StateView() = default;
  virtual void schedule(TaskList& tasks, const std::vector<Material>& materials, int stateSize,
                        const ParticleLabel<double>& state) const = 0;
};

template <class T>
class StateViewOf : public StateView {
 public:
  explicit StateViewOf(const StateVariable& variable) : label_(variable.label, variable.unit, variable.description) {}
  void schedule(TaskList& tasks, const std::vector<Material>& materials, int stateSize,
                const ParticleLabel<double>& state) const override {
    tasks.perMaterial("mpm::showState", showState<T>, materials, with(label_.name), with(stateSize), requiresOld(state),
                      computes(label_));
  }

 private:
  ParticleLabel<T> label_;
};

/// The state variables of all materials, without duplicates, and those of Uintah that are always 0 in Tushar.
inline std::vector<std::shared_ptr<const StateView>> stateViews(const std::vector<Material>& materials) {
  std::vector<std::shared_ptr<const StateView>> views;
  std::set<std::string_view> known;
  const auto add = [&](const std::vector<StateVariable>& variables) {
    for (const StateVariable& variable : variables) {
      if (!known.insert(variable.label).second) continue;
      if (variable.components == 9)
        views.push_back(std::make_shared<StateViewOf<Matrix3>>(variable));
      else
        views.push_back(std::make_shared<StateViewOf<double>>(variable));
    }
  };
  for (const Material& material : materials) {
    add(material.model->stateVariables());
    add(material.model->absentVariables());
  }
  return views;
}

}  // namespace tushar::mpm::solid
