#include "components/mpm/solid/damage/damage.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/mpm/particles/drawn.hpp"
#include "components/mpm/solid/by_color.hpp"

namespace tushar::mpm::solid {

DamageState damagedAtStart(double mean, double deviation, ParticleId id) {
  return {deviation > 0 ? std::abs(mean + deviation * drawnNormal(Drawing::damage, 0, id)) : mean, 0, false};
}

Vec3 principalValues(const Matrix3& tensor) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
}

double greatestStrain(const Matrix3& deformation) {
  const Matrix3 b = deformation * deformation.transpose();
  return 0.5 * (1 - 1 / principalValues(b)[2]);
}

double JohnsonCookDamage::fractureStrain(const MaterialConstants& material, const DamageConditions& conditions,
                                         const Matrix3& stress) const {
  const double equivalent = std::sqrt(1.5) * deviator(stress).norm(), mean = stress.trace() / 3;
  const double triaxiality = equivalent > 0 ? std::clamp(mean / equivalent, -1.5, 1.5) : 0.0;
  const double rate = conditions.plasticStrainRate;
  const double byRate = rate < 1 ? std::pow(1 + rate, d4) : 1 + d4 * std::log(rate);
  const double temperature =
      (conditions.temperature - material.roomTemperature) / (material.meltTemperature - material.roomTemperature);
  return (d1 + d2 * std::exp(d3 * triaxiality)) * byRate * (1 + d5 * temperature);
}

void JohnsonCookDamage::grow(const MaterialConstants& material, const DamageConditions& conditions, Matrix3& stress,
                             DamageState& state) const {
  if (conditions.plasticStrainRate > 0) {
    const double bearable = fractureStrain(material, conditions, stress);
    state.damage = bearable > 0 ? state.damage + conditions.plasticStrainRate * conditions.timeStep / bearable : 1.0;
  }
  if (state.damage < leastDamage) state.damage = 0;
  if (state.damage >= 1 && conditions.erodes) state.hasFailed = true;
}

void HancockMackenzieDamage::grow(const MaterialConstants&, const DamageConditions& conditions, Matrix3& stress,
                                  DamageState& state) const {
  const double equivalent = std::sqrt(1.5) * deviator(stress).norm();
  if (conditions.plasticStrainRate > 0 && equivalent > 0 && stress.trace() > 0)
    state.damage +=
        conditions.plasticStrainRate * conditions.timeStep / 1.65 * std::exp(0.5 * stress.trace() / equivalent);
}

void BrittleDamage::grow(const MaterialConstants&, const DamageConditions& conditions, Matrix3& stress,
                         DamageState& state) const {
  const double energy = std::sqrt(young) * std::max(greatestStrain(conditions.deformation), 0.0);
  if (stress.trace() > 0 && energy > state.threshold) {
    const double rate = threshold * conditions.size * (1 + shape) / (fractureEnergy * shape) * std::log(1 + shape);
    const double spread = 1 + shape * std::exp(-rate * (energy - threshold));
    state.damage = std::min(0.999 / shape * ((1 + shape) / spread - 1), state.damage + greatestStep);
    state.threshold = energy;
  }
  stress *= 1 - state.damage;
}

DamageState ThresholdDamage::initial(double volume, ParticleId id) const {
  const double n = exponent.value_or(distribution == Distribution::weibull ? deviation : 1);
  const double scale = scalesWithVolume ? std::pow(*referenceVolume / volume, 1 / n) : 1;
  switch (distribution) {
    case Distribution::gauss:
      return {0, std::abs(mean + deviation * drawnNormal(Drawing::threshold, seed, id)) * scale, false};
    case Distribution::uniform:
      return {0, (mean + (2 * drawn(Drawing::threshold, seed, id, 0) - 1) * deviation) * scale, false};
    case Distribution::weibull: {
      const double unit = std::pow(-std::log(drawn(Drawing::threshold, seed, id, 0)), 1 / deviation);
      return {0, mean / std::tgamma(1 + 1 / deviation) * unit * scale, false};
    }
    default:
      return {0, mean, false};
  }
}

DamageState ThresholdVarDamage::initial(double volume, ParticleId id, double color) const {
  ThresholdDamage own = *this;
  own.mean = valueByColor(table.entries, color, &Entry::mean);
  own.deviation = valueByColor(table.entries, color, &Entry::deviation);
  return own.initial(volume, id);
}

bool ThresholdDamage::isBeyond(const DamageConditions& conditions, const Matrix3& stress, double threshold) const {
  if (criterion == Criterion::principalStrain) return greatestStrain(conditions.deformation) > threshold;
  const Vec3 s = principalValues(stress);
  if (criterion == Criterion::principalStress) return s[2] > threshold;
  const double angle = frictionAngle * std::numbers::pi / 180, shear = 0.5 * (s[2] - s[0]),
               middle = 0.5 * (s[2] + s[0]);
  return s[2] > tensileCutoff * threshold || shear > threshold * std::cos(angle) - middle * std::sin(angle);
}

void ThresholdDamage::grow(const MaterialConstants&, const DamageConditions& conditions, Matrix3& stress,
                           DamageState& state) const {
  if (localizes && !state.hasFailed) state.hasFailed = isBeyond(conditions, stress, state.threshold);
}

}  // namespace tushar::mpm::solid
