#pragma once

#include "components/mpm/solid/explicit/keeps.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/node_record.hpp"

namespace tushar::mpm::solid {

/// Views of the variables with which F, the stress and internal variables are updated in a step.
template <int D>
struct StateUpdate {
  NodeView<const NodeRecord> record;  ///< record with the velocity that changes F

  // Values at the start of the step.
  ParticleView<const Vec<D>> x;
  Sizes<D> size;
  ParticleView<const Vec<D>> velocity;
  ParticleView<const double> mass;
  ParticleView<const Matrix3> oldDeformation;
  OptionalView<const double> temperature, oldVolume;
  OptionalView<const Matrix3> oldStress;
  OptionalView<const double> oldState;
  OptionalView<const int> localized;

  // Values at the end of the step.
  ParticleView<Matrix3> deformation;
  OptionalView<double> volume;
  OptionalView<Matrix3> stress;
  OptionalView<double> state, viscosity, strainEnergy, temperatureChange;
  OptionalView<Matrix3> velocityGradient;
  Minimum& stableTimeStep;
  std::optional<CellView<double>> stableTimeSteps;  ///< stable time step of each cell
  OptionalView<Vec<D>> newX;                        ///< new positions, if particles can be removed

  int stateSize = 0;  ///< number of values per particle in `state`

  /// `removes`: whether positions at the end of the step are available, so that particles can be removed.
  static StateUpdate from(auto& take, int ghostNodes, const Keeps& keeps, const NodeLabel<NodeRecord>* record,
                          bool removes) {
    return {.record = take(requiresNew(*record, ghostNodes)),
            .x = take(requiresOld(p::x<D>)),
            .size = Sizes<D>::from(take, keeps.sizes),
            .velocity = take(requiresOld(p::velocity<D>)),
            .mass = take(requiresOld(p::mass)),
            .oldDeformation = take(requiresOld(p::deformationMeasure)),
            .temperature = take(when(keeps.temperature, requiresOld(p::temperature))),
            .oldVolume = take(when(keeps.stress, requiresOld(p::volume))),
            .oldStress = take(when(keeps.stress, requiresOld(p::stress))),
            .oldState = take(when(keeps.hasState(), requiresOld(*keeps.state))),
            .localized = take(when(keeps.failure, requiresOld(p::localized))),
            .deformation = take(computes(p::deformationMeasure)),
            .volume = take(when(keeps.stress, computes(p::volume))),
            .stress = take(when(keeps.stress, computes(p::stress))),
            .state = take(when(keeps.hasState(), computes(*keeps.state))),
            .viscosity = take(when(keeps.viscosity, computes(p::viscosity))),
            .strainEnergy = take(offers(p::strainEnergy)),
            .temperatureChange = take(when(keeps.temperatureChange, computes(p::temperatureChange))),
            .velocityGradient = take(offers(p::velocityGradient)),
            .stableTimeStep = take(computes(total::stableTimeStep)),
            .stableTimeSteps = take(offers(c::stableTimeStep)),
            .newX = take(when(removes, modifies(p::x<D>))),
            .stateSize = keeps.stateSize};
  }
};

}  // namespace tushar::mpm::solid
