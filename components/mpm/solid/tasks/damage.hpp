#pragma once

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// Particles start with the damage of the scene, each with its own threshold; none has failed.
inline void initializeDamage(const Patch&, const Material& material, ParticleView<const ParticleId> id,
                             ParticleView<const double> volume, ParticleView<double> damage,
                             ParticleView<double> threshold, ParticleView<int> localized,
                             ParticleView<double> failureTime) {
  for (int p = 0; p < damage.owned(); ++p) {
    const DamageState start =
        std::visit([&](const auto& model) { return model.initial(volume[p], id[p]); }, material.damage);
    damage[p] = start.damage;
    threshold[p] = start.threshold;
    localized[p] = 0;
    failureTime[p] = -1e99;
  }
}

/// Nothing has failed where nothing can.
inline void showSound(const Patch&, const Material&, ParticleView<const double> mass, ParticleView<int> localized) {
  for (int p = 0; p < mass.owned(); ++p) localized[p] = 0;
}

/// Damage at the end of the step, and what damaged and failed particles bear of the stress. Uintah's computeBasicDamage
/// and updateErosionParameter.
inline void computeDamage(const Patch&, const Material& material, int stateSize, double time, double dt,
                          ParticleView<const double> temperature, ParticleView<const double> oldDamage,
                          ParticleView<const double> oldThreshold, ParticleView<const int> oldLocalized,
                          ParticleView<const double> oldFailureTime, ParticleView<const Matrix3> deformation,
                          ParticleView<const double> volume, std::optional<ParticleView<const double>> state,
                          ParticleView<Matrix3> stress, ParticleView<double> damage, ParticleView<double> threshold,
                          ParticleView<int> localized, ParticleView<double> failureTime) {
  const int rate = offsetOf(*material.model, "p.plasticStrainRate");
  const MaterialConstants constants = material.constants();
  for (int p = 0; p < stress.owned(); ++p) {
    const double plasticStrainRate = rate < 0 ? 0.0 : (&(*state)[0])[p * stateSize + rate];
    const DamageConditions conditions{deformation[p], volume[p], plasticStrainRate, temperature[p], dt};
    DamageState now{oldDamage[p], oldThreshold[p], oldLocalized[p] != 0};
    std::visit([&](const auto& model) { model.grow(constants, conditions, stress[p], now); }, material.damage);
    if (material.erosion.acts() && material.model->isMolten(deformation[p], stress[p], temperature[p]))
      now.hasFailed = true;
    damage[p] = now.damage;
    threshold[p] = now.threshold;
    localized[p] = now.hasFailed ? 1 : 0;
    failureTime[p] = now.hasFailed && !oldLocalized[p] ? time : oldFailureTime[p];
    if (now.hasFailed) stress[p] = material.erosion.bearable(stress[p], time - failureTime[p]);
  }
}

}  // namespace tushar::mpm::solid
