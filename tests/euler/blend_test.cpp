#include <gtest/gtest.h>

#include "components/euler/blend.hpp"

// Gases with laws of their own that share cells.

namespace tushar::euler {

namespace {

Gas gasOf(const ColdCurve& cold, double gamma, double specificHeat) {
  return {.specificHeat = specificHeat, .law = std::make_shared<const Gas::Law>(CurvedGas(cold, gamma, specificHeat))};
}
/// An explosive, its products by JWLC and by JWL, and air.
Gas explosive() {
  return gasOf({.kind = ColdCurve::Kind::murnaghan,
                .density = 1160,
                .exponent = 7.4,
                .compressibility = 3.9e-10,
                .pressureThere = 101325},
               0, 1500);
}
const ColdCurve products{
    .density = 1160, .a = 2.9867e11, .b = 4.11706e9, .c = 7.206147e8, .r1 = 4.95, .r2 = 1.15, .omega = 0.35};
Gas jwlc() { return gasOf(products, 0, 545); }
Gas jwl() {
  ColdCurve cold = products;
  cold.c = 0;
  return gasOf(cold, 0.35, 1000);
}
Gas air() { return {.gamma = 1.4, .specificHeat = 716}; }
/// Products of an explosive, as molecules that are hard spheres.
Gas spheres() {
  return {.specificHeat = 716,
          .law = std::make_shared<const Gas::Law>(
              RealGas({.gasConstant = 0.3 * 716, .specificHeat = 716, .covolume = 7.84e-4}))};
}
Gas water() { return {.specificHeat = 4145, .law = std::make_shared<const Gas::Law>(Water({}))}; }

using Masses = std::array<double, kMostGases>;

/// The internal energy per volume of gases with volume fractions at a pressure and a temperature, and their masses.
double energyOf(const std::vector<Gas>& gases, const std::vector<double>& shares, double pressure, double temperature,
                Masses& masses) {
  double energy = 0;
  for (std::size_t k = 0; k < gases.size(); ++k) {
    const double rho = gases[k].densityAt(pressure, temperature);
    masses[k] = shares[k] * rho;
    energy += shares[k] * gases[k].energyOf(rho, gases[k].lastAt(rho, temperature));
  }
  return energy;
}

}  // namespace

TEST(Blend, FindsPressureAndTemperature) {
  const std::vector<std::vector<Gas>> groups{
      {explosive(), jwlc(), air()}, {jwl(), air(), explosive()}, {spheres(), air(), explosive()}};
  for (const std::vector<Gas>& gases : groups)
    for (const double pressure : {2e4, 101325.0, 1e7, 5e9, 3e10})
      for (const double temperature : {200.0, 300.0, 4000.0})
        for (const std::vector<double>& shares : std::vector<std::vector<double>>{
                 {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.3, 0.2}, {1 - 1e-6, 0, 1e-6}, {1e-9, 1 - 1e-9, 0}}) {
          Masses masses{};
          const double energy = energyOf(gases, shares, pressure, temperature, masses);
          const Blend blend = BlendLaws(gases).at(masses.data(), energy);
          ASSERT_TRUE(blend.isPossible) << pressure << ' ' << temperature;
          EXPECT_NEAR(blend.temperature / temperature, 1, 1e-9) << pressure;
          // The pressure of the explosive has the round-off error of 1e-16 of its stiffness.
          EXPECT_NEAR(blend.pressure, pressure, 1e-9 * pressure + 1e-4) << temperature;
          for (std::size_t k = 0; k < gases.size(); ++k) EXPECT_NEAR(blend.shares[k], shares[k], 1e-9);
        }
}

TEST(Blend, IsTheSameWhereverItsSearchBegins) {
  const std::vector<std::vector<Gas>> groups{
      {explosive(), jwlc(), air()}, {jwl(), air(), explosive()}, {spheres(), air(), explosive()}};
  for (const std::vector<Gas>& gases : groups)
    for (const double pressure : {2e4, 101325.0, 1e7, 5e9, 3e10})
      for (const double temperature : {250.0, 3000.0})
        for (const std::vector<double>& shares :
             {std::vector{.3, .6, .1}, {.9, .1 - 1e-9, 1e-9}, {1e-12, .5, .5 - 1e-12}}) {
          Masses masses;
          const double energy = energyOf(gases, shares, pressure, temperature, masses);
          const BlendLaws laws(gases);
          const Blend expected = laws.at(masses.data(), energy);
          const std::vector<Masses> guesses{{shares[0], shares[1], shares[2]},
                                            {shares[0] * 1.01, shares[1] * .99, shares[2]},
                                            {shares[2], shares[0], shares[1]},
                                            {1e-3, .998, 1e-3},
                                            {0, .5, .5},
                                            {-1, 1, 1},
                                            {3e9, -2, 0}};
          for (const Masses& guess : guesses) {
            const Blend found = laws.at(masses.data(), energy, guess.data());
            ASSERT_EQ(found.isPossible, expected.isPossible);
            EXPECT_NEAR(found.pressure, expected.pressure, 1e-11 * expected.pressure + 1e-11 * expected.modulus);
            EXPECT_NEAR(found.temperature, expected.temperature, 1e-11 * temperature);
            for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found.shares[k], expected.shares[k], 1e-11 * shares[k]);
          }
        }
}

TEST(Blend, OfWaterFindsPressureAndTemperature) {
  const std::vector<Gas> gases{water(), air(), spheres()};
  for (const double pressure : {2e4, 101325.0, 2e6, 1e8})
    for (const double temperature : {278.0, 300.0, 330.0})
      for (const std::vector<double>& shares : std::vector<std::vector<double>>{
               {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.2, 0.3, 0.5}, {1 - 1e-6, 1e-6, 0}, {1e-9, 1 - 1e-9, 0}}) {
        Masses masses{};
        const double energy = energyOf(gases, shares, pressure, temperature, masses);
        const Blend blend = BlendLaws(gases).at(masses.data(), energy);
        ASSERT_TRUE(blend.isPossible) << pressure << ' ' << temperature << ' ' << shares[0];
        EXPECT_NEAR(blend.temperature / temperature, 1, 1e-9) << pressure;
        EXPECT_NEAR(blend.pressure, pressure, 1e-9 * pressure + 1e-4) << temperature;  // round-off of its stiffness
        for (std::size_t k = 0; k < gases.size(); ++k) EXPECT_NEAR(blend.shares[k], shares[k], 1e-9);
      }
}

TEST(Blend, OfWaterAloneIsItsLaw) {
  const BlendLaws laws({water(), air()});
  const Masses masses{998, 0, 0};
  const Gas gas = water();
  const double energy = gas.energyOf(998, gas.lastAt(998, 320));
  const Blend blend = laws.at(masses.data(), energy);
  ASSERT_TRUE(blend.isPossible);
  EXPECT_NEAR(blend.pressure / gas.pressure(998, energy), 1, 1e-9);
  EXPECT_NEAR(blend.modulus / (998 * gas.soundSpeedSquared(998, gas.last(998, energy))), 1, 1e-9);
}

TEST(Blend, OfWaterAndAirMayBeWhereWaterAloneHasNoRange) {
  const BlendLaws laws({water(), air()});
  const std::vector<Gas> gases{water(), air()};
  Masses masses{};
  const double cold = energyOf(gases, {0, 1}, 101325, 250, masses);
  masses[0] = 1e-3;  // below the temperature of greatest density
  const Blend below = laws.at(masses.data(), cold + masses[0] * 4205.7 * (250 - 277));
  EXPECT_TRUE(below.isPossible);
  EXPECT_NEAR(below.temperature, 250, 0.5);
  const double hot = energyOf(gases, {0, 1}, 101325, 900, masses);
  masses[0] = 1e-5;  // a trace
  EXPECT_TRUE(laws.at(masses.data(), hot).isPossible);
  masses[0] = 100;
  EXPECT_FALSE(laws.at(masses.data(), 100 * 4205.7 * 400).isPossible) << "water at 677 K";
}

TEST(Blend, OfWaterThatDoesNotFillItsCellHasAlmostNoPressure) {
  const BlendLaws laws({water(), air()});
  const Gas gas = water();
  const double rho = gas.densityAt(0, 300), perMass = gas.energyOf(rho, 0) / rho;
  for (const double filled : {0.5, 0.9999, 0.999999})
    for (const double trace : {0.0, 1e-268, 1e-100, 1e-20}) {
      const Masses masses{filled * rho, trace, 0};
      const Blend blend = laws.at(masses.data(), masses[0] * perMass);
      EXPECT_TRUE(blend.isPossible) << filled << ' ' << trace;
      EXPECT_LE(blend.pressure, 1e-6);
      EXPECT_NEAR(blend.temperature, 300, 1e-6);
      EXPECT_GT(blend.modulus, 0);
    }
}

TEST(Blend, IsImpossibleAtPressuresThatItDoesNotSeek) {
  const BlendLaws laws({explosive(), air()});
  const Masses masses{0, 1e5, 0};
  EXPECT_TRUE(laws.at(masses.data(), 2e16).isPossible);
  EXPECT_FALSE(laws.at(masses.data(), 4e16).isPossible) << "1.6e16 Pa";
}

TEST(Blend, SaysUpToWhereTheLawOfWaterIsValid) {
  EXPECT_EQ(BlendLaws({water(), air()}).limits(), "; the law of the water is valid between 277 and 352.7 K (at p = 0)");
  EXPECT_EQ(BlendLaws({jwl(), air()}).limits(), "");
}

class BlendOf : public testing::TestWithParam<Gas> {};
/// Without it, tests would be named after the bytes of a gas.
[[maybe_unused]] void PrintTo(const Gas& gas, std::ostream* out) { *out << "c_v = " << gas.specificHeat; }

INSTANTIATE_TEST_SUITE_P(Products, BlendOf, testing::Values(jwl(), spheres(), water()));

TEST_P(BlendOf, HasTheSoundSpeedOfItsIsentrope) {
  const std::vector<Gas> gases{explosive(), GetParam(), air()};
  const BlendLaws laws(gases);
  Masses masses{};
  const bool isWater = std::holds_alternative<Water>(*GetParam().law);
  const double pressure = isWater ? 3e6 : 3e8, temperature = isWater ? 300 : 900, step = isWater ? 1e-6 : 1e-5;
  const double energy = energyOf(gases, {0.4, 0.4, 0.2}, pressure, temperature, masses);
  const Blend blend = laws.at(masses.data(), energy);
  // Compression by a factor 1 + s changes e per volume by (e + p) s.
  const auto after = [&](double s) {
    Masses more = masses;
    for (double& mass : more) mass *= 1 + s;
    const double middle = energy + 0.5 * s * (energy + blend.pressure);
    const double there = laws.at(more.data(), middle).pressure;  // close to the mean of both ends
    return laws.at(more.data(), energy + s * (0.5 * (energy + middle) + 0.5 * (blend.pressure + there))).pressure;
  };
  EXPECT_NEAR((after(step) - after(-step)) / (2 * step) / blend.modulus, 1, 1e-4);
}

TEST(Blend, OfAirAloneIsAnIdealGas) {
  const BlendLaws laws({explosive(), air()});
  const Masses masses{0, 1.2, 0};
  const double energy = 1.2 * 716 * 300;
  const MixedGas law = laws.at(masses.data(), energy).law(energy);
  EXPECT_NEAR(law.softness, 2.5, 1e-13);
  EXPECT_NEAR(law.stiffness / energy, 0, 1e-14);
  EXPECT_NEAR(law.soundSpeedSquared(1.2, 0.4 * energy) / (1.4 * 0.4 * 716 * 300), 1, 1e-13);
}

TEST(Blend, OfHardSpheresAloneIsTheirLaw) {
  const BlendLaws laws({spheres(), air()});
  const Masses masses{400, 0, 0};
  const double energy = 400 * 716 * 2000.0;
  const Blend blend = laws.at(masses.data(), energy);
  const Gas gas = spheres();
  EXPECT_NEAR(blend.pressure / gas.pressure(400, energy), 1, 1e-13);
  EXPECT_NEAR(blend.pressure / (0.3 * energy / (1 - 7.84e-4 * 400)), 1, 1e-13);
  EXPECT_NEAR(blend.modulus / (400 * gas.soundSpeedSquared(400, gas.last(400, energy))), 1, 1e-13);
  const Masses tooDense{1300, 0, 0};  // more than 1 / b
  EXPECT_FALSE(laws.at(tooDense.data(), energy).isPossible);
}

TEST(Blend, OfALiquidInTensionHasAlmostNoPressure) {
  const BlendLaws laws({explosive(), air()});
  const Masses masses{1000, 0, 0};
  const Blend blend = laws.at(masses.data(), 1000 * 1500 * 300.0);
  EXPECT_TRUE(blend.isPossible);
  EXPECT_LT(blend.pressure, 1e-50);
  EXPECT_DOUBLE_EQ(blend.shares[0], 1);
  EXPECT_GT(blend.modulus, 0);
}

TEST(Blend, IsImpossibleWithoutHeat) {
  const BlendLaws laws({explosive(), jwlc()});
  const Masses masses{0, 1500, 0};
  const double cold = products.energy(1500);
  EXPECT_FALSE(laws.at(masses.data(), 0.99 * cold).isPossible);
  EXPECT_TRUE(laws.at(masses.data(), 1.01 * cold).isPossible);
  EXPECT_FALSE(laws.at(masses.data(), std::nan("")).isPossible);
}

}  // namespace tushar::euler
