#pragma once

#include <string_view>
#include <variant>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// The variables of one particle at the end of a step that determine the growth of damage.
struct DamageConditions {
  const Matrix3& deformation;  ///< deformation gradient F [1]
  double size;                 ///< size of the particle [m]
  double plasticStrainRate;    ///< plastic strain rate [1/s]
  double temperature;          ///< temperature [K]
  double timeStep;             ///< time step [s]
  bool erodes = true;          ///< whether failed particles lose stress
};

/// Damage of one particle.
struct DamageState {
  double damage;     ///< damage [1]; 0 if the particle is intact
  double threshold;  ///< threshold above which damage grows: a stress, a strain or the root of an energy
  bool hasFailed;
};

/// Initial damage |mean + deviation n|, where n = drawnNormal(Drawing::damage, 0, id).
DamageState damagedAtStart(double mean, double deviation, ParticleId id);

/// No damage.
struct NoDamage {
  static constexpr std::string_view name = "none";
  static const input::Schema<NoDamage>& schema();
  DamageState initial(double, ParticleId) const { return {0, 0, false}; }
  void grow(const MaterialConstants&, const DamageConditions&, Matrix3&, DamageState&) const {}
};

/// Johnson-Cook damage, D = sum de_p / e_f, e_f = (D1 + D2 exp(D3 s*)) (1 + D4 ln e*) (1 + D5 T*), s* = mean stress /
/// equivalent stress: Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31. A particle that erodes fails at D = 1. As in
/// Uintah, |s*| is limited to 1.5, and the rate factor is (1 + e*)^D4 below 1/s.
struct JohnsonCookDamage {
  static constexpr std::string_view name = "johnson_cook";
  double d1 = 0, d2 = 0, d3 = 0, d4 = 0, d5 = 0;
  double initialDamage = 0, initialDeviation = 0;
  bool startsSpread = false;   ///< whether the initial damage is normally distributed
  double leastDamage = 1e-10;  ///< damage below this value is set to 0

  static const input::Schema<JohnsonCookDamage>& schema();
  DamageState initial(double, ParticleId id) const {
    return damagedAtStart(initialDamage, startsSpread ? initialDeviation : 0, id);
  }
  /// The fracture strain e_f [1].
  double fractureStrain(const MaterialConstants& material, const DamageConditions& conditions,
                        const Matrix3& stress) const;
  void grow(const MaterialConstants& material, const DamageConditions& conditions, Matrix3& stress,
            DamageState& state) const;
};

/// The damage D = sum de_p / e_f, e_f = 1.65 exp(-3/2 mean stress / equivalent stress): Hancock & Mackenzie, J. Mech.
/// Phys. Solids 24 (1976) 147. As in Uintah, it grows in tension only, and does not make particles fail.
struct HancockMackenzieDamage {
  static constexpr std::string_view name = "hancock_mackenzie";
  double initialDamage = 0, initialDeviation = 0;
  bool startsSpread = false;  ///< whether the initial damage is normally distributed

  static const input::Schema<HancockMackenzieDamage>& schema();
  DamageState initial(double, ParticleId id) const {
    return damagedAtStart(initialDamage, startsSpread ? initialDeviation : 0, id);
  }
  void grow(const MaterialConstants& material, const DamageConditions& conditions, Matrix3& stress,
            DamageState& state) const;
};

/// Damage of brittle materials as a function of the square root of the energy of the largest principal strain, r =
/// E^(1/2) e_max, above a threshold r_0: d = 0.999/D ((1 + D) / (1 + D exp(-C (r - r_0))) - 1) with C = r_0 h (1 + D)
/// ln(1 + D) / (G_f D) for a particle of size h; the stress of the model is multiplied by 1 - d. A model that
/// increments the stress of the previous step, such as hypo_elastic, is weakened again in every step, as in Uintah.
/// Leavy, Brannon & Strack, Int. J. Appl. Ceram. Technol. 7 (2010) 606; Uintah's `Brittle`.
struct BrittleDamage {
  static constexpr std::string_view name = "Brittle";
  double threshold = 57;         ///< threshold r_0 [Pa^(1/2)]
  double fractureEnergy = 11.2;  ///< fracture energy G_f [J/m^2]
  double shape = 0.1;            ///< shape D [1]
  double greatestStep = 0.1;     ///< largest growth of d in one step [1]
  double young = 0;              ///< Young's modulus E [Pa]

  static const input::Schema<BrittleDamage>& schema();
  DamageState initial(double, ParticleId) const { return {0, threshold, false}; }
  void grow(const MaterialConstants&, const DamageConditions& conditions, Matrix3& stress, DamageState& state) const;
};

/// A particle fails immediately if its largest principal stress or strain, or its Mohr-Coulomb stress, exceeds a
/// threshold, which may differ between particles.
struct ThresholdDamage {
  enum class Criterion { principalStress, principalStrain, mohrCoulomb };
  enum class Distribution { constant, gauss, weibull, uniform };
  static constexpr std::string_view name = "Threshold";
  Criterion criterion = Criterion::principalStress;
  Distribution distribution = Distribution::constant;
  double mean = 0, deviation = 0;
  int seed = 0;
  bool scalesWithVolume = false;
  std::optional<double> referenceVolume;  ///< volume to which the threshold refers [m^3]
  std::optional<double> exponent;
  double frictionAngle = 0;  ///< friction angle [degrees]
  double tensileCutoff = 0;  ///< largest tension, as a fraction of the cohesion
  bool localizes = true;

  static const input::Schema<ThresholdDamage>& schema();
  /// The threshold of a particle, from random numbers drawn() for its id.
  DamageState initial(double volume, ParticleId id) const;
  void grow(const MaterialConstants&, const DamageConditions& conditions, Matrix3& stress, DamageState& state) const;

 private:
  bool isBeyond(const DamageConditions& conditions, const Matrix3& stress, double threshold) const;
};

/// A ThresholdDamage whose mean and standard deviation are functions of p.color.
struct ThresholdVarDamage : ThresholdDamage {
  static constexpr std::string_view name = "ThresholdVar";
  struct Entry {
    double color = 0, mean = 0, deviation = 0;
  };
  struct Table {
    std::vector<Entry> entries;  ///< entries in order of increasing color
  };
  Table table;

  static const input::Schema<ThresholdVarDamage>& schema();
  DamageState initial(double volume, ParticleId id, double color) const;
};

using Damage = std::variant<NoDamage, JohnsonCookDamage, HancockMackenzieDamage, BrittleDamage, ThresholdDamage,
                            ThresholdVarDamage>;

/// The principal values of a tensor, the smallest first.
Vec3 principalValues(const Matrix3& tensor);
/// The largest principal value of the Almansi strain, (I - (F Fᵀ)^-1)/2.
double greatestStrain(const Matrix3& deformation);

}  // namespace tushar::mpm::solid
