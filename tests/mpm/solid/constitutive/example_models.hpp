#pragma once

#include <vector>

#include "components/mpm/solid/constitutive/all.hpp"

namespace tushar::mpm::solid::testing {

/// An example of each type of model, with constants of the order of 1 unless given.
template <class M>
M withModuli(double bulk = 7, double shear = 3) {
  M model;
  model.bulkModulus = bulk;
  model.shearModulus = shear;
  return model;
}
inline CompMooneyRivlin compMooneyRivlin(double c1 = 3, double c2 = 1, double poissonRatio = 0.45) {
  CompMooneyRivlin model;
  model.c1 = c1;
  model.c2 = c2;
  model.poissonRatio = poissonRatio;
  return model;
}
inline ArrudaBoyce8 lockingRubber(double lockingStretch = 1.7) {
  auto model = withModuli<ArrudaBoyce8>();
  model.lockingStretch = lockingStretch;
  return model;
}
inline CompNeoHookPlastic compNeoHookPlastic(double hardening) {
  auto model = withModuli<CompNeoHookPlastic>();
  model.yieldStress = 0.2;
  model.hardeningModulus = hardening;
  return model;
}
inline ElasticPlasticHp elasticPlastic(const FlowModel& flow) {
  auto model = withModuli<ElasticPlasticHp>();
  model.flow = flow;
  model.material = {2, 0.5, 2000, 294};
  return model;
}
/// A yield stress of each type, between .05 and .5 for the moduli of elasticPlastic at 300 K and rates of some 100/s.
inline std::vector<FlowModel> flowModels() {
  JohnsonCook soft{0.1, 0.3, 0.025, 0.31, 1.09, 1, 298, 1356};
  MechanicalThreshold threshold;
  threshold.athermal = threshold.sigmaI = 0.05;
  threshold.shearModulus = 3.2;
  threshold.boltzmann = 3e-4;
  threshold.energyI = threshold.energyE = 1.6;
  threshold.rateI = threshold.rateE = threshold.rateSaturated = 1e7;
  threshold.pI = threshold.pE = 2.0 / 3.0;
  threshold.qI = threshold.qE = 1;
  threshold.a0 = 0.6;
  threshold.a1 = 0.01;
  threshold.a2 = 1e-3;
  threshold.a3 = 3e-4;
  threshold.alpha = 3;
  threshold.energySaturated = 0.5;
  threshold.sigmaSaturated = 0.3;
  const PrestonTonksWallace tonks{0.1, 2, 0.03, 0.01, 0.3, 1e-5, 0.02, 0.006, 0.05, 0.5, 0.25, 60};
  const SteinbergCochranGuinan saturating{3, 0.1, 0.15, 30, 0.4, 0};
  const SteinbergCochranGuinan lund{3, 0.1, 0.15, 30, 0.4, 0, 1e6, 1e-5, 0.31, 8.617e-5, 0.1};
  const ZerilliArmstrong crystal{0.1, 0.1, 0.3, 0.1, 0.5, 3e-3, 1e-4, 5e-3, 3e-4};
  return {IsotropicHardening{0.2, 0.5}, soft, threshold, tonks, saturating, lund, crystal};
}
/// A ligament, with or without relaxation.
template <class M = TransIsoHyper>
M ligament() {
  M model;
  model.bulkModulus = 7;
  model.c1 = 1;
  model.c2 = 0.5;
  model.c3 = 0.4;
  model.c4 = 3;
  model.c5 = 5;
  model.straight = 1.05;
  model.fibre = {2, 1, 2};
  return model;
}
/// Two Maxwell elements, one of which relaxes within one or two steps.
inline ViscoTransIsoHyper relaxingLigament() {
  auto model = ligament<ViscoTransIsoHyper>();
  model.y1 = 0.5;
  model.t1 = 2e-3;
  model.y4 = 1.5;
  model.t4 = 0.1;
  return model;
}
inline MwViscoElastic springBesideMaxwell() {
  return {.springShear = 1,
          .springBulk = 2,
          .maxwellShear = 3,
          .maxwellBulk = 5,
          .bulkViscosity = 3,
          .shearViscosity = 0.6};
}
inline ElasticPlasticHp relaxingMetal(const FlowModel& flow) {
  auto model = elasticPlastic(flow);
  model.deviatorModel = MaxwellDeviator{2, {1, 2}, {0.01, 0.1}};
  return model;
}
inline ViscoScram explosive() {
  ViscoScram model;
  model.poissonRatio = 0.3;
  model.crackScale = 1e-3;
  model.crackPower = 2;
  model.greatestCrackSpeed = 1e-3;
  model.toughness = 0.5;
  model.crackFriction = 0.35;
  model.initialCrackRadius = 1e-3;
  model.tensileSpeedUp = 12;
  model.g1 = 1;
  model.g3 = 2;
  model.rate3 = 100;
  model.gruneisen = 1;
  model.material = {2, 0.5, 2000, 294};
  return model;
}
/// An explosive with a thermal expansion of 1/1000 per kelvin: K = 6.5 Pa.
inline ExpandingViscoScram hotExplosive() {
  ExpandingViscoScram model{explosive()};
  model.scram.thermalExpansion = 1e-3;
  return model;
}
/// The ice of the scene suvic_10minus4.ups, which Uintah ships.
inline ViscoPlastic ice() {
  ViscoPlastic model;
  model.bulkModulus = 8.9e9;
  model.shearModulus = 3.52e9;
  model.material = {917, 2000, 273, 294};
  return model;
}
inline MohrCoulomb mohrCoulomb(double friction, double dilation) {
  auto model = withModuli<MohrCoulomb>();
  model.cohesion = 0.1;
  model.frictionAngle = friction;
  model.dilationAngle = dilation;
  return model;
}
/// Copper of Johnson & Cook, Proc. 7th Int. Symp. on Ballistics (1983), table 1.
inline JohnsonCook copper() {
  return {.a = 90e6, .b = 292e6, .c = 0.025, .n = 0.31, .m = 1.09, .roomTemperature = 298, .meltTemperature = 1356};
}

}  // namespace tushar::mpm::solid::testing
