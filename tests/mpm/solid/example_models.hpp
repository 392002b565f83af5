#pragma once

#include "components/mpm/solid/materials/all.hpp"

namespace tushar::mpm::solid::testing {

/// A model of each kind, with constants of the order of 1 unless others are given.
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
inline MohrCoulomb mohrCoulomb(double friction, double dilation) {
  auto model = withModuli<MohrCoulomb>();
  model.cohesion = 0.1;
  model.frictionAngle = friction;
  model.dilationAngle = dilation;
  return model;
}
/// Copper of Johnson & Cook, Proc. 7th Int. Symp. on Ballistics (1983), table 1.
inline JohnsonCook copper() {
  JohnsonCook model;
  model.a = 90e6;
  model.b = 292e6;
  model.n = 0.31;
  model.c = 0.025;
  model.m = 1.09;
  model.roomTemperature = 298;
  model.meltTemperature = 1356;
  return model;
}

}  // namespace tushar::mpm::solid::testing
