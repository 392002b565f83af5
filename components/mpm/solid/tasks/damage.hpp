#pragma once

#include <cmath>
#include <optional>

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/problem.hpp"
#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// The initial damage of a particle with this volume [m^3] and p.color.
inline DamageState initialDamage(const Damage& damage, double volume, ParticleId id, double color) {
  return std::visit(
      [&](const auto& model) {
        if constexpr (requires { model.initial(volume, id, color); })
          return model.initial(volume, id, color);
        else
          return model.initial(volume, id);
      },
      damage);
}

/// Initialises the damage of particles from the scene, each with its own threshold; no particle has failed yet.
inline void initializeDamage(const Patch&, const Material& material, ParticleView<const ParticleId> id,
                             ParticleView<const double> volume, OptionalView<const double> color,
                             ParticleView<double> damage, ParticleView<double> threshold, ParticleView<int> localized,
                             ParticleView<double> failureTime) {
  for (int p = 0; p < damage.owned(); ++p) {
    const DamageState start = initialDamage(material.damage, volume[p], id[p], color ? (*color)[p] : 0.0);
    damage[p] = start.damage;
    threshold[p] = start.threshold;
    localized[p] = 0;
    failureTime[p] = -1e99;
  }
}

inline void scheduleInitialDamage(TaskList& tasks, const std::vector<Material>& materials) {
  const bool byColor = std::any_of(materials.begin(), materials.end(), [](const Material& material) {
    return std::holds_alternative<ThresholdVarDamage>(material.damage);
  });
  tasks.perMaterial("mpm::initializeDamage", initializeDamage, materials, requiresNew(data::particleId),
                    requiresNew(p::volume), when(byColor, requiresNew(p::color)), computes(p::damage),
                    computes(p::failureThreshold), computes(p::localized), computes(p::failureTime));
}

/// Marks all particles as intact if there is no damage model.
inline void showSound(const Patch&, const Material&, ParticleView<const double> mass, ParticleView<int> localized) {
  for (int p = 0; p < mass.owned(); ++p) localized[p] = 0;
}

/// Views of the particles whose damage grows in a step.
template <int D>
struct DamageGrowth {
  std::optional<ParticleView<const Vec<D>>> x;  ///< positions, in axisymmetric scenes
  ParticleView<const Matrix3> oldDeformation;
  ParticleView<const double> temperature, oldDamage, oldThreshold;
  ParticleView<const int> oldLocalized;
  ParticleView<const double> oldFailureTime;
  ParticleView<const Matrix3> deformation;  ///< deformation at the end of the step, like all following views
  ParticleView<const double> volume;
  OptionalView<const double> state;  ///< internal variables, if any model has some
  ParticleView<Matrix3> stress;
  ParticleView<double> damage, threshold;
  ParticleView<int> localized;
  ParticleView<double> failureTime;

  static DamageGrowth from(auto& take, const ParticleLabel<double>* state, bool axisymmetric) {
    return {.x = take(when(axisymmetric, requiresOld(p::x<D>))),
            .oldDeformation = take(requiresOld(p::deformationMeasure)),
            .temperature = take(requiresOld(p::temperature)),
            .oldDamage = take(requiresOld(p::damage)),
            .oldThreshold = take(requiresOld(p::failureThreshold)),
            .oldLocalized = take(requiresOld(p::localized)),
            .oldFailureTime = take(requiresOld(p::failureTime)),
            .deformation = take(requiresNew(p::deformationMeasure)),
            .volume = take(requiresNew(p::volume)),
            .state = take(when(state->components > 0, requiresNew(*state))),
            .stress = take(modifies(p::stress)),
            .damage = take(computes(p::damage)),
            .threshold = take(computes(p::failureThreshold)),
            .localized = take(computes(p::localized)),
            .failureTime = take(computes(p::failureTime))};
  }

  /// The size of a particle [m]: the cube root of its volume or, in axisymmetric scenes, where volumes are per radian,
  /// the square root of its area in the plane.
  double sizeOf(int p) const { return x ? std::sqrt(volume[p] / (*x)[p][0]) : std::cbrt(volume[p]); }
};

/// Whether the plastic flow of a particle has become unstable in the step, judged by the stress before damage.
template <int D>
bool isUnstable(const Material& material, int p, int stateSize, double dt, const DamageGrowth<D>& d) {
  if (!material.erosion.acts() || !d.state || !material.model->checksStability()) return false;
  const Matrix3& f = d.deformation[p];
  const Matrix3 velocityGradient = (f * d.oldDeformation[p].inverse() - Matrix3::Identity()) / dt;
  return material.model->isUnstable({f, d.oldDeformation[p], velocityGradient, dt, d.temperature[p]}, d.stress[p],
                                    &(*d.state)[0] + p * stateSize);
}

/// Computes damage at the end of the step, and the stress that damaged and failed particles still support: Uintah's
/// computeBasicDamage and updateErosionParameter.
template <int D>
void computeDamage(const Patch&, const Material& material, int stateSize, double time, double dt,
                   const DamageGrowth<D>& d) {
  const int rate = offsetOf(*material.model, "p.plasticStrainRate");
  const MaterialConstants constants = material.constants();
  for (int p = 0; p < d.stress.owned(); ++p) {
    const double plasticStrainRate = rate < 0 ? 0.0 : (&(*d.state)[0])[p * stateSize + rate];
    const DamageConditions conditions{d.deformation[p], d.sizeOf(p), plasticStrainRate,
                                      d.temperature[p], dt,          material.erosion.acts()};
    DamageState now{d.oldDamage[p], d.oldThreshold[p], d.oldLocalized[p] != 0};
    const bool losesStability = !now.hasFailed && isUnstable(material, p, stateSize, dt, d);
    std::visit([&](const auto& model) { model.grow(constants, conditions, d.stress[p], now); }, material.damage);
    if (losesStability ||
        (material.erosion.acts() && material.model->isMolten(d.deformation[p], d.stress[p], d.temperature[p])))
      now.hasFailed = true;
    d.damage[p] = now.damage;
    d.threshold[p] = now.threshold;
    d.localized[p] = now.hasFailed ? 1 : 0;
    d.failureTime[p] = now.hasFailed && !d.oldLocalized[p] ? time : d.oldFailureTime[p];
    if (now.hasFailed) d.stress[p] = material.erosion.bearable(d.stress[p], time - d.failureTime[p]);
  }
}

/// Adds the tasks for damage; `state` contains the internal variables of the constitutive models.
template <int D>
void scheduleDamage(TaskList& tasks, const Problem& problem, const ParticleLabel<double>& state) {
  tasks.perMaterial("mpm::computeDamage", computeDamage<D>, problem.materials, with(state.components), startTime(),
                    requiresOld(delT), all<DamageGrowth<D>>(&state, problem.start.axisymmetric));
}

}  // namespace tushar::mpm::solid
