#include "components/mpm/solid/constitutive/p_alpha.hpp"

#include <gtest/gtest.h>

#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {
namespace {

/// A metal powder: a0 = 1.25, crushed between 1 and 20, in units in which its solid has the density 2.
PAlpha powder() {
  PAlpha model;
  model.material = {.density = 1.6, .specificHeat = 3};
  model.closingPressure = 20;
  model.elasticLimit = 1;
  model.solidDensity = 2;
  model.porousModulus = 50;
  model.solidModulus = 400;
  model.referenceTemperature = 300;
  model.soundSpeed = 14;
  model.gruneisen = 1.5;
  model.hugoniotSlope = 1.4;
  return model;
}
constexpr double atStart = 1.25, atLimit = 1.25 * (1 - 1.0 / 50);

Matrix3 atDistension(double alpha) { return std::cbrt(alpha / atStart) * Matrix3::Identity(); }
double pressureOf(const MaterialPoint<PAlpha>& point) { return -point.oldStress.trace() / 3; }

/// The point after it has been compressed to a distension.
MaterialPoint<PAlpha> crushedTo(double alpha) {
  MaterialPoint<PAlpha> point{powder()};
  point.advance(atDistension(alpha));
  return point;
}

TEST(PAlpha, FollowsTheCrushCurveOfHerrmann) {
  EXPECT_NEAR(pressureOf(crushedTo(1.24)), 50 * (1 - 1.24 / 1.25), 1e-12) << "elastic at first";
  for (const double p : {1.0, 3.0, 10.0, 19.0, 20.0}) {
    const double alpha = 1 + (atLimit - 1) * std::pow((20 - p) / (20 - 1), 2);
    const auto point = crushedTo(alpha);
    EXPECT_NEAR(pressureOf(point), p, 1e-6) << alpha;
    EXPECT_LT(deviator(point.oldStress).norm(), 1e-12);
  }
}

TEST(PAlpha, UnloadsAlongOneLineAndReloadsToTheCurve) {
  const double least = 1.15;
  MaterialPoint<PAlpha> point = crushedTo(least);
  const double crushed = pressureOf(point);
  // Herrmann's slope at a*; ce² = 50/1.6, cs² = 400/2.
  const double h = 1 + (std::sqrt(50 / 1.6 / 200) - 1) * (least - 1) / 0.25;
  const double slope = 400 / std::max(least * least * (1 / (h * h) - 1), 1.0);
  ASSERT_LT(slope, 400);
  for (const double alpha : {1.155, 1.16, 1.152}) {
    point.advance(atDistension(alpha));
    EXPECT_NEAR(pressureOf(point), crushed - slope * (alpha - least), 1e-10);
    EXPECT_EQ(point.oldState.alphaMin, crushedTo(least).oldState.alphaMin);
  }
  point.advance(atDistension(1.05));
  EXPECT_NEAR(pressureOf(point), pressureOf(crushedTo(1.05)), 1e-10);
}

TEST(PAlpha, HasNoJumpWhereItsPressureVanishes) {
  for (const double least : {1.24, 1.1}) {
    MaterialPoint<PAlpha> point = crushedTo(least);
    double free = least, end = 2;  // the distension without pressure, by bisection
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (free + end);
      point.advance(atDistension(middle));
      (pressureOf(point) > 0 ? free : end) = middle;
    }
    point.advance(atDistension(1.1 * free));
    EXPECT_NEAR(pressureOf(point), 5 * (1 - 1.1), 1e-10) << "Ku is K0/10";
    if (least > atLimit) {
      EXPECT_NEAR(free, atStart, 1e-12);
    }
  }
}

TEST(PAlpha, BecomesASolidWithTheHugoniotOfItsConstants) {
  MaterialPoint<PAlpha> point = crushedTo(1.0);
  for (const double alpha : {0.95, 0.9}) {
    point.advance(atDistension(alpha));
    // p = rhoS c² x (1 - G x / 2) / (1 - s x)² with x = 1 - a, in another form.
    const double x = 1 - alpha, cold = 2 * 196 * x * (1 - 0.75 * x) / std::pow(1 - 1.4 * x, 2);
    EXPECT_NEAR(pressureOf(point), 20 + cold, 1e-9);
  }
  point.temperature = 310;
  point.advance(atDistension(0.9));
  EXPECT_NEAR(pressureOf(point) - pressureOf(crushedTo(0.9)), 1.5 * 2 * 3 * 10, 1e-9);
}

TEST(PAlpha, TurnsTheWorkOfCrushingIntoHeat) {
  MaterialPoint<PAlpha> point = crushedTo(atLimit);
  const int steps = 2000;
  double heated = 0;
  for (int k = 1; k <= steps; ++k) {
    const Matrix3 f = atDistension(atLimit + (1 + 1e-9 - atLimit) * k / steps);  // the pores stay open
    const Deformation step = point.step(f);
    const Matrix3 before = point.oldStress;
    point.advance(f);
    heated += point.model.temperatureChange(step, 0.5 * (before + point.oldStress), point.oldState);
  }
  // The integral of p dv / c_v, v = a/rhoS; the mean of the root in p(a) is 2/3.
  const double meanPressure = 20 - 2.0 / 3.0 * (20 - 1);
  EXPECT_NEAR(heated, meanPressure * (atLimit - 1) / 2 / 3, 1e-4);

  MaterialPoint<PAlpha> unloading = crushedTo(1.1);
  const Deformation step = unloading.step(atDistension(1.11));
  unloading.advance(atDistension(1.11));
  EXPECT_EQ(unloading.model.temperatureChange(step, unloading.oldStress, unloading.oldState), 0);
}

// Except where the last pores close: there, the crush curve is vertical.
TEST(PAlpha, HasNoWaveFasterThanItsWaveSpeed) {
  for (const double alpha : {1.24, 1.15, 1.05, 0.95, 0.85}) {
    const MaterialPoint<PAlpha> point = crushedTo(alpha);
    const double speed = point.model.waveSpeed(1.6, point.step(point.oldDeformation), point.oldStress, point.oldState);
    for (const double change : {-1e-6, 1e-6}) {
      MaterialPoint<PAlpha> next = point;
      next.advance(atDistension(alpha * (1 + change)));
      const double modulus = -(pressureOf(next) - pressureOf(point)) / change, density = 2 / alpha;
      EXPECT_LT(modulus / density, speed * speed * (1 + 1e-4)) << alpha << ' ' << change;
    }
  }
}

TEST(PAlpha, ShearsLikeCompNeoHookPlastic) {
  PAlpha model = powder();
  model.shearModulus = 3;
  model.yieldStress = 0.2;
  model.hardeningModulus = 0.5;
  MaterialPoint<PAlpha> point{model};
  CompNeoHookPlastic sheared;
  sheared.shearModulus = 3;
  sheared.yieldStress = 0.2;
  sheared.hardeningModulus = 0.5;
  MaterialPoint<CompNeoHookPlastic> same{sheared};
  for (const double strain : {0.02, 0.1}) {
    point.advance(generalDeformation(strain));
    same.advance(generalDeformation(strain));
    EXPECT_LT((deviator(point.oldStress) - deviator(same.oldStress)).norm(), 1e-12);
  }
  EXPECT_EQ(point.oldState.plasticStrain, same.oldState.plasticStrain);
  EXPECT_GT(point.oldState.plasticStrain, 0);
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
