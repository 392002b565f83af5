#include <gtest/gtest.h>

#include "components/mpm/solid/constitutive/th_water.hpp"
#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {

namespace {

constexpr double roundOff = 1e-12;  ///< some hundred operations, each exact to 1e-16

ThWater thWater() {
  ThWater water;
  water.pressureShift = 2e-7;
  water.heatSlope = 2.6;
  water.specificHeat = 4205.7;
  water.compressibility = 5e-10;
  water.densestTemperature = 277;
  water.curvature = 8e-6;
  water.densestVolume = 1.00008e-3;
  water.material.density = 995.7;
  return water;
}

}  // namespace

TEST(Water, HasThePressureOfItsDensityAndTheShearOfItsRate) {
  Water water;
  water.bulkModulus = 2;
  water.exponent = 7;
  water.viscosity = 0.3;
  Matrix3 rate = Matrix3::Zero();
  rate(0, 1) = 4;
  Water::State none;
  const Matrix3 f = std::cbrt(0.9) * Matrix3::Identity();
  const Matrix3 stress = water.updateStress({f, f, rate, 1, 300}, Matrix3::Zero(), none);
  EXPECT_NEAR(stress.trace() / 3, -2 * (std::pow(0.9, -7) - 1), roundOff);
  EXPECT_NEAR(stress(0, 1), 0.3 * 4, roundOff);
}

TEST(Water, HasNoWaveSpeedWhereAParticleIsInverted) {
  Water water;
  water.bulkModulus = 2;
  water.exponent = 7;
  const Matrix3 f = -Matrix3::Identity();
  EXPECT_TRUE(std::isnan(water.waveSpeed(1, {f, f, Matrix3::Zero(), 1, 300}, Matrix3::Zero(), {})));
}

TEST(ThWater, HasTheVolumeOfItsPressureAndTemperature) {
  MaterialPoint<ThWater> point{thWater()};
  for (const double temperature : {277.0, 290.0, 310.0})
    for (const double squeezed : {1.001, 0.99, 0.98}) {
      point.temperature = temperature;
      const double p = 101325 - point.stress(std::cbrt(squeezed) * Matrix3::Identity())(0, 0);
      const double warm = temperature - 277 + 2e-7 * p;
      EXPECT_NEAR(1.00008e-3 * (1 - 5e-10 * p + 8e-6 * warm * warm), squeezed / 995.7, 1e-16);
    }
}

/// c² = -v² dp/dv along the adiabat, by differences; also beyond the formula's range.
TEST(ThWater, CarriesSoundAsFastAsItsAdiabatSays) {
  for (const double squeezed : {1.0, 0.95, 0.9, 0.895, 0.89, 0.88, 0.86, 0.8, 0.5}) {
    const double h = 1e-5;
    MaterialPoint<ThWater> point{thWater()};
    point.oldDeformation = std::cbrt(squeezed) * Matrix3::Identity();
    const auto pressureAfter = [&](double stretch) {
      MaterialPoint<ThWater> moved = point;
      const Matrix3 f = std::cbrt(stretch) * point.oldDeformation;
      moved.temperature += moved.model.temperatureChange(moved.step(f), Matrix3::Zero(), {});
      return -moved.stress(f)(0, 0);
    };
    const double stiffness = (pressureAfter(1 - h) - pressureAfter(1 + h)) / (2 * h) * squeezed / 995.7;
    const double speed = point.model.waveSpeed(995.7, point.step(point.oldDeformation), Matrix3::Zero(), {});
    EXPECT_NEAR(speed / std::sqrt(stiffness), 1, 1e-6) << squeezed;
    if (squeezed == 1.0) {
      EXPECT_NEAR(speed / 1500, 1, 0.05) << "of water";
    }
  }
}

TEST(ThWater, HasASpeedOfSoundAndMorePressureTheMoreItIsSqueezed) {
  MaterialPoint<ThWater> point{thWater()};
  for (const double temperature : {250.0, 300.0, 350.0, 372.0}) {
    point.temperature = temperature;
    double before = -1e99;
    for (double squeezed = 1.02; squeezed > 0.3; squeezed -= 0.002) {
      const Matrix3 f = std::cbrt(squeezed) * Matrix3::Identity();
      const double pressure = -point.stress(f)(0, 0);
      EXPECT_GT(pressure, before);
      before = pressure;
      const double speed = point.model.waveSpeed(995.7, point.step(f), Matrix3::Zero(), {});
      EXPECT_TRUE(speed > 500 && speed < 2e4) << speed << " m/s at " << squeezed << ", " << temperature << " K";
    }
  }
}

/// Checks c² = dp/drho for each equation of state.

}  // namespace tushar::mpm::solid::testing
