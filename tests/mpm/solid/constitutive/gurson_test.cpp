#include <gtest/gtest.h>

#include "components/mpm/solid/constitutive/gurson.hpp"
#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {
namespace {

constexpr double yieldStress = 0.2;

GursonPlastic porous(double porosity, double hardening = 0) {
  GursonPlastic model{elasticPlastic(IsotropicHardening{yieldStress, hardening})};
  model.base.equationOfState = HypoelasticVolume{};
  model.base.yieldCondition = GursonYield{1.5, 1, 2.25, 4, 0.05};
  model.base.initialPorosity = porosity;
  model.base.nucleating = 0;
  return model;
}

const GursonYield& surfaceOf(const GursonPlastic& model) { return std::get<GursonYield>(model.base.yieldCondition); }

/// The hydrostatic strength: cosh(3 q2 p / (2 sigma_y)) = (1 + q3 f*²) / (2 q1 f*).
double hydrostaticStrength(const GursonYield& surface, double porosity) {
  const double f = surface.effective(porosity);
  return yieldStress * 2 / (3 * surface.q2) * std::acosh((1 + surface.q3 * f * f) / (2 * surface.q1 * f));
}

TEST(GursonYield, EndsAtItsHydrostaticStrength) {
  const GursonYield surface{1.5, 1, 2.25, 4, 0.05};
  for (const double f : {0.002, 0.05, 0.1}) {
    const double p = hydrostaticStrength(surface, f) / yieldStress;
    EXPECT_NEAR(surface.square(p, f), 0, 1e-12);
    EXPECT_GT(surface.strength(0.99 * p, f), 0);
  }
  EXPECT_EQ(surface.strength(5, 0), 1) << "without pores it is von Mises'";
  EXPECT_NEAR(surface.strength(0, 0.02), 1 - 1.5 * 0.02, 1e-15) << "1 - q1 f where q3 = q1²";
}

TEST(GursonPlastic, IsVonMisesWithoutPores) {
  MaterialPoint<GursonPlastic> point{porous(0, 0.5)};
  MaterialPoint<ElasticPlasticHp> solid{point.model.base};
  for (const double strain : {0.02, 0.2, 0.1}) {
    const Matrix3 f = generalDeformation(strain);
    EXPECT_LT((point.stress(f) - solid.stress(f)).norm(), 1e-10 * solid.stress(f).norm());
    point.advance(f);
    solid.advance(f);
  }
  EXPECT_GT(solid.oldState.plasticStrain, 0);
  EXPECT_NEAR(point.oldState.plasticStrain, solid.oldState.plasticStrain, 1e-10);
}

/// Hydrostatic tension: the stress stays on the yield surface, and the volume of the solid phase is constant.
TEST(GursonPlastic, OpensItsPoresInHydrostaticTension) {
  MaterialPoint<GursonPlastic> point{porous(0.01)};
  const int steps = 200;
  for (int k = 1; k <= steps; ++k) {
    point.advance((1 + 0.05 * k / steps) * Matrix3::Identity());
    if (k < 3 * steps / 5) continue;  // until then it is elastic
    const double mean = point.oldStress.trace() / 3;
    EXPECT_NEAR(mean, hydrostaticStrength(surfaceOf(point.model), point.oldState.porosity), 1e-10);
    EXPECT_LT(deviator(point.oldStress).norm(), 1e-12);
  }
  const double dilatation = point.oldState.dilatation;
  EXPECT_GT(dilatation, 0.05);
  EXPECT_NEAR((1 - point.oldState.porosity) * std::exp(dilatation), 1 - 0.01, 1e-12);
}

TEST(GursonPlastic, ReturnsToTheSurfaceByItsNormal) {
  for (const double swelling : {-0.05, 0.05}) {
    MaterialPoint<GursonPlastic> point{porous(0.03, 0.5)};
    const auto before = point.oldState;
    const Matrix3 f = (1 + swelling) * generalDeformation(0.1);
    point.advance(f);
    const auto& now = point.oldState;
    const double yield = yieldStress + 0.5 * now.plasticStrain, mean = point.oldStress.trace() / 3;
    const double equivalent = std::sqrt(1.5) * deviator(point.oldStress).norm();
    const GursonYield& surface = surfaceOf(point.model);
    EXPECT_NEAR(equivalent / yield, surface.strength(mean / yield, now.porosity), 1e-9);
    const double dilatation = now.dilatation - before.dilatation;
    EXPECT_GT(dilatation * mean, 0) << "pores open in tension, close under pressure";
    const double shear = (now.plasticWork - mean * dilatation) / equivalent;
    EXPECT_NEAR(2 * dilatation * equivalent / yield, shear * surface.dilatancy(mean / yield, now.porosity), 1e-9);
    EXPECT_NEAR(now.plasticWork, (1 - now.porosity) * yield * now.plasticStrain, 1e-9);
  }
}

TEST(GursonYield, LosesItsStrengthWithItsPoresForGood) {
  for (const double q3 : {0.0, 1.0, 2.25, 3.0}) {
    const GursonYield surface{1.5, 1, q3, 4, 0.05};
    double before = 1;
    for (double f = 0; f < 0.999; f += 0.01) {
      const double now = surface.strength(0, f);
      EXPECT_LE(now, before + 1e-15) << f;
      before = now;
    }
    EXPECT_NEAR(before, q3 > 2.25 ? std::sqrt(1 - 2.25 / q3) : 0, 1e-7) << "the root of round-off";
  }
}

TEST(GursonPlastic, KeepsThePoresThatDoNotEvolve) {
  for (const double swelling : {-0.05, 0.05}) {
    MaterialPoint<GursonPlastic> point{porous(0.03, 0.5)};
    point.model.base.poresEvolve = false;
    point.model.base.nucleating = 0.1;
    for (const double strain : {0.1, 0.15}) point.advance((1 + swelling) * generalDeformation(strain));
    const auto& now = point.oldState;
    EXPECT_EQ(now.porosity, 0.03);
    const double yield = yieldStress + 0.5 * now.plasticStrain, mean = point.oldStress.trace() / 3;
    const double equivalent = std::sqrt(1.5) * deviator(point.oldStress).norm();
    EXPECT_GT(now.dilatation * mean, 0);
    EXPECT_NEAR(equivalent / yield, surfaceOf(point.model).strength(mean / yield, 0.03), 1e-9);
  }
}

TEST(GursonPlastic, StartsWithLessPoresThanVolume) {
  GursonPlastic model = porous(0.5);
  model.base.porositySpreads = true;
  model.base.porosityDeviation = 1;
  double greatest = 0;
  for (ParticleId id = 0; id < 1000; ++id) greatest = std::max(greatest, model.initialState({id, 0}).porosity);
  EXPECT_EQ(greatest, 0.999);
  MaterialPoint<GursonPlastic> point{model};
  point.oldState.porosity = greatest;
  EXPECT_TRUE(point.stress(1.05 * generalDeformation(0.1)).allFinite());
  EXPECT_TRUE(point.stress(0.95 * generalDeformation(0.1)).allFinite());
}

TEST(GursonPlastic, IsObjective) {
  const MaterialPoint<GursonPlastic> point{porous(0.03, 0.5)};
  const Matrix3 turn = rotation(0.8), f = 1.03 * generalDeformation(0.1);
  Deformation d = point.step(f);
  auto state = point.oldState, turned = point.oldState;
  const Matrix3 stress = point.model.updateStress(d, point.oldStress, state);
  d.deformationGradient = turn * f;
  d.oldDeformationGradient = turn * point.oldDeformation;
  d.velocityGradient = turn * d.velocityGradient * turn.transpose();
  const Matrix3 seen = point.model.updateStress(d, point.oldStress, turned);
  EXPECT_LT((seen - turn * stress * turn.transpose()).norm(), 1e-10 * stress.norm());
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
