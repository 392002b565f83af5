#include "components/mpm/solid/damage/damage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tushar::mpm::solid {

namespace {

/// The n-th random number in (0, 1) of a particle: Steele, Lea & Flood's SplitMix, OOPSLA (2014).
double draw(int seed, ParticleId id, std::uint64_t n) {
  std::uint64_t z = static_cast<std::uint64_t>(id) * 4 + n + 0x9e3779b97f4a7c15u * static_cast<std::uint64_t>(seed + 1);
  for (const auto& [shift, factor] : {std::pair{30, 0xbf58476d1ce4e5b9u}, std::pair{27, 0x94d049bb133111ebu}}) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> shift)) * factor;
  }
  z ^= z >> 31;
  return (static_cast<double>(z >> 11) + 0.5) * 0x1p-53;
}

/// By Box and Muller.
double drawNormal(int seed, ParticleId id) {
  return std::sqrt(-2 * std::log(draw(seed, id, 0))) * std::cos(2 * std::numbers::pi * draw(seed, id, 1));
}

}  // namespace

Harm damagedAtStart(double mean, double deviation, ParticleId id) {
  return {deviation > 0 ? std::abs(mean + deviation * drawNormal(0, id)) : mean, 0, false};
}

double greatestStrain(const Matrix3& deformation) {
  const Matrix3 b = deformation * deformation.transpose();
  return 0.5 * (1 - 1 / principalValues(b)[2]);
}

double JohnsonCookDamage::fractureStrain(const MaterialConstants& material, const DamageState& state,
                                         const Matrix3& stress) const {
  const double equivalent = std::sqrt(1.5) * deviator(stress).norm(), mean = stress.trace() / 3;
  const double triaxiality = equivalent > 0 ? std::clamp(mean / equivalent, -1.5, 1.5) : 0.0;
  const double rate = state.plasticStrainRate;
  const double byRate = rate < 1 ? std::pow(1 + rate, d4) : 1 + d4 * std::log(rate);
  const double temperature =
      (state.temperature - material.roomTemperature) / (material.meltTemperature - material.roomTemperature);
  return (d1 + d2 * std::exp(d3 * triaxiality)) * byRate * (1 + d5 * temperature);
}

void JohnsonCookDamage::grow(const MaterialConstants& material, const DamageState& state, Matrix3& stress,
                             Harm& harm) const {
  if (state.plasticStrainRate > 0) {
    const double bearable = fractureStrain(material, state, stress);
    harm.damage = bearable > 0 ? harm.damage + state.plasticStrainRate * state.timeStep / bearable : 1.0;
  }
  if (harm.damage < leastDamage) harm.damage = 0;
  if (harm.damage >= 1) harm.hasFailed = true;
}

void HancockMackenzieDamage::grow(const MaterialConstants&, const DamageState& state, Matrix3& stress,
                                  Harm& harm) const {
  const double equivalent = std::sqrt(1.5) * deviator(stress).norm();
  if (state.plasticStrainRate > 0 && equivalent > 0 && stress.trace() > 0)
    harm.damage += state.plasticStrainRate * state.timeStep / 1.65 * std::exp(0.5 * stress.trace() / equivalent);
}

void BrittleDamage::grow(const MaterialConstants&, const DamageState& state, Matrix3& stress, Harm& harm) const {
  const double energy = std::sqrt(young) * std::max(greatestStrain(state.deformation), 0.0);
  if (stress.trace() > 0 && energy > harm.threshold) {
    const double size = std::cbrt(state.volume);
    const double rate = threshold * size * (1 + shape) / (fractureEnergy * shape) * std::log(1 + shape);
    const double spread = 1 + shape * std::exp(-rate * (energy - threshold));
    harm.damage = std::min(0.999 / shape * ((1 + shape) / spread - 1), harm.damage + greatestStep);
    harm.threshold = energy;
  }
  stress *= 1 - harm.damage;
}

Harm ThresholdDamage::initial(double volume, ParticleId id) const {
  const double n = exponent.value_or(distribution == Distribution::weibull ? deviation : 1);
  const double scale = scalesWithVolume ? std::pow(*referenceVolume / volume, 1 / n) : 1;
  switch (distribution) {
    case Distribution::gauss:
      return {0, std::abs(mean + deviation * drawNormal(seed, id)) * scale, false};
    case Distribution::uniform:
      return {0, (mean + (2 * draw(seed, id, 0) - 1) * deviation) * scale, false};
    case Distribution::weibull: {
      const double unit = std::pow(-std::log(draw(seed, id, 0)), 1 / deviation);
      return {0, mean / std::tgamma(1 + 1 / deviation) * unit * scale, false};
    }
    default:
      return {0, mean, false};
  }
}

bool ThresholdDamage::isBeyond(const DamageState& state, const Matrix3& stress, double threshold) const {
  if (criterion == Criterion::principalStrain) return greatestStrain(state.deformation) > threshold;
  const Vec3 s = principalValues(stress);
  if (criterion == Criterion::principalStress) return s[2] > threshold;
  const double angle = frictionAngle * std::numbers::pi / 180, shear = 0.5 * (s[2] - s[0]),
               middle = 0.5 * (s[2] + s[0]);
  return s[2] > tensileCutoff * threshold || shear > threshold * std::cos(angle) - middle * std::sin(angle);
}

void ThresholdDamage::grow(const MaterialConstants&, const DamageState& state, Matrix3& stress, Harm& harm) const {
  if (localizes && !harm.hasFailed) harm.hasFailed = isBeyond(state, stress, harm.threshold);
}

}  // namespace tushar::mpm::solid
