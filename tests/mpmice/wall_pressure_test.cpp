#include "components/mpmice/wall_pressure.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace tushar::mpmice {

namespace {

const euler::Gas air{};  // gamma = 1.4
// p = 1, rho = 1.4: the speed of sound is 1.
constexpr double density = 1.4, pressure = 1;

/// Products of an explosive (HMX), dense or thin.
euler::Gas products() {
  const euler::ColdCurve curve{
      .density = 1832, .a = 1668.9e9, .b = 59.69e9, .c = 6.43e8, .r1 = 5.9, .r2 = 2.1, .omega = 0.45};
  euler::Gas gas;
  gas.law = std::make_shared<const euler::Gas::Law>(euler::CurvedGas(curve, 0.45, 595));
  return gas;
}

double on(double closing) { return wallPressure(air, density, pressure, closing); }

}  // namespace

TEST(WallPressure, IsThatOfTheGasOnAWallThatMovesWithIt) { EXPECT_EQ(on(0), 1); }

TEST(WallPressure, IsThatBehindTheShockThatThrowsTheGasBack) {
  // A shock of Mach number M gives the gas 2 (M - 1/M) / (gamma + 1) and 1 + 2 gamma (M^2 - 1) / (gamma + 1).
  for (const double mach : {1.001, 1.5, 3.0, 100.0}) {
    const double closing = 2 * (mach - 1 / mach) / 2.4, expected = 1 + 2.8 * (mach * mach - 1) / 2.4;
    EXPECT_NEAR(on(closing) / expected, 1, 1e-14) << mach;
  }
}

TEST(WallPressure, IsThatOfAnIsentropicFanBehindAWallThatDrawsBack) {
  // u + 2 c / (gamma - 1) stays constant, so the wall retreats at 2.5 where the speed of sound is halved.
  EXPECT_NEAR(on(-2.5), 1.0 / 128, 1e-16);
  EXPECT_NEAR(on(-1), std::pow(0.8, 7), 1e-15);
}

TEST(WallPressure, IsNoneWhereTheWallOutrunsTheGas) {
  EXPECT_EQ(on(-5.001), 0);
  EXPECT_EQ(on(-1e9), 0);
  EXPECT_EQ(wallPressure({4.4, 6}, 1, 2, -1e9), -6);
}

TEST(WallPressure, OfSlowWallsIsThatOfSound) {
  for (const double closing : {1e-6, -1e-6}) EXPECT_NEAR((on(closing) - 1) / (density * closing), 1, 2e-6);
}

TEST(WallPressure, GrowsWithTheSpeedAndIsNeverNegative) {
  double before = 0;
  for (double closing = -6; closing < 6; closing += 0.01) {
    const double now = on(closing);
    EXPECT_GE(now, before) << closing;
    before = now;
  }
}

TEST(WallPressure, OfStrongShocksIsThatOfTheMomentumAlone) {
  EXPECT_NEAR(on(1e6) / (1.2 * density * 1e12), 1, 1e-6);  // (gamma + 1) / 2 rho u^2
}

TEST(WallPressure, OfAStiffenedGasIsThatOfAnIdealOneWithTheStiffnessAdded) {
  const euler::Gas water{4.4, 6}, ideal{4.4, 0};
  for (const double closing : {-1.0, -0.1, 0.3, 20.0})
    EXPECT_NEAR(wallPressure(water, 2, 1, closing), wallPressure(ideal, 2, 7, closing) - 6, 1e-11);
}

TEST(WallPressure, OfAGasWithALawOfItsOwnIsThatOfTheGasItIs) {
  // Without its exponentials, the JWL law is that of an ideal gas.
  euler::Gas byLaw = air;
  byLaw.law = std::make_shared<const euler::Gas::Law>(euler::CurvedGas({.density = 1}, 0.4, 716));
  for (const double closing : {-4.0, -1.0, -1e-3, 0.0, 1e-3, 0.3, 20.0})
    EXPECT_NEAR(wallPressure(byLaw, density, pressure, closing), on(closing), 1e-6 * std::max(1.0, on(closing)))
        << closing;
  EXPECT_EQ(wallPressure(byLaw, density, pressure, -6), 0);
}

TEST(WallPressure, OfAGasWithALawOfItsOwnIsRightHoweverSlowTheWallIs) {
  euler::Gas byLaw = air;
  byLaw.law = std::make_shared<const euler::Gas::Law>(euler::CurvedGas({.density = 1}, 0.4, 716));
  for (int k = 0; k < 2000; ++k) {
    const double rho = 0.5 + k / 1999.0, closing = std::pow(10, -20 + k % 17);
    EXPECT_NEAR(wallPressure(byLaw, rho, 1, closing), wallPressure(air, rho, 1, closing), 1e-8 * closing + 1e-15);
  }
}

TEST(WallPressure, OfALawMeetsTheJumpConditionsToRoundOff) {
  const euler::Gas gas = products();
  for (const double rho : {1e-3, 7.7, 300.0, 1900.0, 2500.0})
    for (const double temperature : {300.0, 4000.0}) {
      const double before = gas.lastAt(rho, temperature), sound = std::sqrt(gas.soundSpeedSquared(rho, before));
      for (const double closing : {1e-5 * sound, 1e-3 * sound, 0.1 * sound, sound, 30 * sound}) {
        const double on = wallPressure(gas, rho, before, closing), jump = closing * closing / (on - before);
        const double energy = gas.energyOf(rho, before) / rho + 0.5 * (on + before) * jump,
                     after = 1 / (1 / rho - jump);
        const double unit = rho * (sound + closing) * (sound + closing);
        // Behind strong shocks, round-off of the volume changes the pressure more.
        EXPECT_NEAR(gas.pressure(after, after * energy), on, 1e-13 * unit * std::max(1.0, after / rho))
            << rho << ' ' << temperature << ' ' << closing / sound;
      }
    }
}

TEST(WallPressure, OfALawInAFanDoesNotDependOnTheNumberOfSteps) {
  euler::Gas stiff;  // its speed of sound falls at once as it expands
  const euler::ColdCurve curve{.kind = euler::ColdCurve::Kind::murnaghan,
                               .density = 1160,
                               .exponent = 7.4,
                               .compressibility = 3.9e-10,
                               .pressureThere = 101325};
  stiff.law = std::make_shared<const euler::Gas::Law>(euler::CurvedGas(curve, 1, 1000));
  for (const euler::Gas& gas : {products(), stiff})
    for (const double rho : {7.7, 300.0, 1160.0, 1900.0}) {
      const double before = gas.lastAt(rho, 3000), sound = std::sqrt(gas.soundSpeedSquared(rho, before));
      for (double speed = 1e-9; speed < 1; speed *= 1.1)
        EXPECT_NEAR(wallPressure(gas, rho, before, -speed * sound),
                    fanPressure(gas, rho, before, speed * sound, mostFanSteps), 4e-15 * rho * sound * sound)
            << rho << ' ' << speed;
    }
}

TEST(WallPressure, OfAStiffLawIsThatOfSoundAtSlowWallsAndOfItsHugoniotAtFastOnes) {
  const euler::ColdCurve curve{.kind = euler::ColdCurve::Kind::murnaghan,
                               .density = 1160,
                               .exponent = 7.4,
                               .compressibility = 3.9e-10,
                               .pressureThere = 101325};
  euler::Gas solid;
  solid.law = std::make_shared<const euler::Gas::Law>(euler::CurvedGas(curve, 0, 1000));
  const double heat = 1160 * 1000 * 300.0, sound = std::sqrt(1 / (3.9e-10 * 1160));
  EXPECT_NEAR((wallPressure(solid, 1160, heat, 0.1) - 101325) / (1160 * sound * 0.1), 1, 1e-3);
  // The jump to 1400 kg/m³: 393.3289926 m/s, 1.046957e9 Pa.
  EXPECT_NEAR(wallPressure(solid, 1160, heat, 393.3289926255606) / 1046956737.5762395, 1, 1e-10);
  EXPECT_GE(wallPressure(solid, 1160, heat, -100), 0);
}

}  // namespace tushar::mpmice
