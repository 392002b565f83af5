#include <gtest/gtest.h>

#include <sstream>

#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

// Yield stresses and shear moduli of the metals of elastic_plastic.

namespace tushar::mpm::solid::testing {
namespace {

constexpr double roundOff = 1e-12;  ///< some hundred operations, each exact to 1e-16

TEST(SpecificHeat, OfCopperAndSteelIsThatOfTables) {
  const auto at = [](const auto& model, double temperature) {
    return model.specificHeat({temperature, 1, 8960, 1e11}, 1);
  };
  // CRC Handbook of Chemistry and Physics: copper 252, 385 and 409 J/(kg K), within 1.5 %
  EXPECT_NEAR(at(CopperHeat(), 100), 252, 0.015 * 252);
  EXPECT_NEAR(at(CopperHeat(), 298), 385, 0.015 * 385);
  EXPECT_NEAR(at(CopperHeat(), 500), 409, 0.015 * 409);
  EXPECT_NEAR(at(CopperHeat(), 270 - 1e-9), at(CopperHeat(), 270), 5) << "the fits meet within 2 %";
  const SteelHeat steel;
  EXPECT_NEAR(at(steel, 520), 190.14 - 273.75 / 2 + 418.3 * std::pow(2, 0.2), 1e-12 * 500);
  EXPECT_NEAR(at(steel, 1560), 465.21 + 267.52 / 2 + 58.16 * std::pow(2, 0.35), 1e-12 * 700);
  EXPECT_TRUE(std::isfinite(at(steel, 1040)));
  EXPECT_EQ(at(ConstantHeat(), 300), 1);
}

/// u = T/theta has the unit K, because theta is 1 at the initial density.
TEST(SpecificHeat, OfTheCubicHasCoefficientsOfOnePowerOfTheTemperatureEach) {
  std::ostringstream text;
  CubicHeat::schema().describeContents(text, 0);
  for (const auto& [tag, unit] :
       {std::pair{"c0", "kg K^4/J"}, {"c1", "kg K^3/J"}, {"c2", "kg K^2/J"}, {"c3", "kg K/J"}}) {
    const std::size_t at = text.str().find(std::string("<") + tag + ">");
    ASSERT_NE(at, std::string::npos) << text.str();
    EXPECT_NE(text.str().substr(at, text.str().find('\n', at) - at).find(unit), std::string::npos) << text.str();
  }
}

TEST(SpecificHeat, OfTheCubicSaturatesAndFollowsTheDensity) {
  const CubicHeat cubic{1.1, -0.2, 0, 0.01, 0.02, 0.003, 0.001};
  EXPECT_NEAR(cubic.specificHeat({2, 1, 2, 3}, 0), 8 / (0.01 + 0.04 + 0.012 + 0.008), 1e-12 * 100);
  EXPECT_NEAR(cubic.specificHeat({1e9, 1, 2, 3}, 0), 1000, 1e-4) << "1/c3";
  // Debye's temperature grows with Grüneisen's coefficient, d ln theta / d ln rho = a + b / eta
  const double debye = std::pow(1.5, 1.1) * std::exp(-0.2 / 3);
  EXPECT_NEAR(cubic.specificHeat({2 * debye, 1.5, 3, 3}, 0), cubic.specificHeat({2, 1, 2, 3}, 0), 1e-10);
  CubicHeat growing = cubic;
  growing.expansion = 0.1;
  EXPECT_NEAR(growing.specificHeat({2, 1, 2, 3}, 0) - cubic.specificHeat({2, 1, 2, 3}, 0), 0.01 * 2 * 3 / 2, 1e-12);
}

TEST(SpecificHeat, DividesTheHeatOfPlasticWork) {
  auto metal = elasticPlastic(IsotropicHardening{0.2, 0.5});
  const Matrix3 before = Matrix3::Identity(), rate = Vec3(-10, 5, 5).asDiagonal();
  const Deformation d{before, before, rate, 0.01, 500};
  const Matrix3 stress = Vec3(-0.4, 0.2, 0.2).asDiagonal();
  const typename ElasticPlasticHp::State state{0.1, 10, 10, 0, {}};
  const double constant = metal.temperatureChange(d, stress, state);
  metal.specificHeat = CopperHeat();
  EXPECT_EQ(metal.temperatureChange(d, stress, state), constant) << "only where compute_specific_heat says so";
  metal.computesHeat = true;
  const double heat = CopperHeat().specificHeat({500, 1, 2, 7}, 0);
  EXPECT_NEAR(metal.temperatureChange(d, stress, state), constant * metal.material.specificHeat / heat,
              roundOff * constant);
}

TEST(FlowModel, OfSteinbergAndLundFulfilsTheirEquation) {
  const SteinbergCochranGuinan flow{3, 0.1, 0.15, 0, 0, 0, 1e6, 1e-5, 0.31, 8.617e-5, 0.1};
  for (const double rate : {1.0, 100.0, 1e3}) {
    const double thermal = flow.flowStress({0, rate, 300, 3, 2, 2000, rate}) - 0.1, away = 1 - thermal / 0.1;
    const double time = std::exp(2 * 0.31 / (8.617e-5 * 300) * away * away) / 1e6 + 1e-5 / thermal;
    EXPECT_NEAR(rate * time, 1, 1e-10);  // its exponential makes some hundred of rounding
  }
  EXPECT_DOUBLE_EQ(flow.flowStress({0, 1e12, 300, 3, 2, 2000, 1e12}), 0.2);
  EXPECT_DOUBLE_EQ(flow.flowStress({0, 0, 300, 3, 2, 2000, 0}), 0.1);
}

TEST(FlowModel, OfPrestonTonksAndWallaceGoesFromYieldToSaturation) {
  const PrestonTonksWallace flow{0.1, 2, 0.03, 0.01, 0.3, 1e-5, 0.02, 0.006, 0.05, 0.5, 0.25, 60};
  FlowState cold{0, 1, 0, 3, 2, 2000, 1};
  EXPECT_NEAR(flow.flowStress(cold), 2 * 3 * 0.02, 1e-15);
  FlowState strained = cold;
  strained.plasticStrain = 1e-7;
  // d t / d e_p = theta / (exp(B/A) - 1) (exp(B/A) - 1) = theta at e_p = 0
  EXPECT_NEAR((flow.flowStress(strained) - flow.flowStress(cold)) / (2 * 3 * 1e-7), 0.1, 1e-5);
  strained.plasticStrain = 100;
  EXPECT_NEAR(flow.flowStress(strained), 2 * 3 * 0.03, 1e-15);
}

TEST(FlowModel, OfPrestonTonksAndWallaceIsANumberHoweverAbruptlyItSaturates) {
  PrestonTonksWallace flow{0.1, 2, 0.03, 0.01, 0.3, 1e-5, 0.02, 0.006, 0.05, 0.5, 0.25, 60};
  for (const double p : {2.0, 35.9, 36.1, 1e3, 1e6}) {
    flow.p = p;
    double before = 0;
    for (const double plasticStrain : {0.0, 1e-9, 1e-5, 1e-3, 0.1, 1.0, 100.0}) {
      const double stress = flow.flowStress({plasticStrain, 1, 0, 3, 2, 2000, 1});
      EXPECT_GE(stress, before - 1e-15) << p << ' ' << plasticStrain;  // rounding of 0.18
      before = stress;
    }
    EXPECT_NEAR(flow.flowStress({0, 1, 0, 3, 2, 2000, 1}), 2 * 3 * 0.02, 1e-14) << p;
    EXPECT_LE(before, 2 * 3 * 0.03 + 1e-14) << p;
  }
}

TEST(FlowModel, OfTheMechanicalThresholdHardensToSaturation) {
  const auto flow = std::get<MechanicalThreshold>(flowModels()[2]);
  const FlowState cold{0, 1e7, 300, 3.2};  // at the rates of reference nothing is activated
  const double hardening = 0.6 + 0.01 * std::log(1e7) + 1e-3 * std::sqrt(1e7) - 3e-4 * 300;
  EXPECT_NEAR(flow.flowStress(cold), 0.05 + 0.05, 1e-15);
  FlowState strained = cold;
  strained.plasticStrain = 1e-7;
  EXPECT_NEAR((flow.flowStress(strained) - flow.flowStress(cold)) / 1e-7, hardening, 1e-4 * hardening);
  strained.plasticStrain = 10;
  EXPECT_NEAR(flow.flowStress(strained), 0.1 + 0.3, 1e-12);
  strained.strainRate = 1;
  EXPECT_LT(flow.flowStress(strained), 0.3);
}

TEST(ShearModel, FallsWithTheTemperature) {
  const Compression cold{0, 1, 0.001, 2, 1000}, warm{0, 1, 500, 2, 1000}, molten{0, 1, 1100, 2, 1000};
  const MtsShear varshni{3.2, 0.1, 200};
  EXPECT_EQ(varshni.modulus(cold, 0), 3.2);
  EXPECT_NEAR(varshni.modulus(warm, 0), 3.2 - 0.1 / (std::exp(0.4) - 1), 1e-15);
  const NpShear nadal{3, 0.05, 0.05, 1e6, 60};
  EXPECT_NEAR(nadal.modulus(cold, 0), 3, 1e-5);  // a millionth of the melting temperature
  EXPECT_NEAR(nadal.modulus(warm, 0), 3 * 0.5 + 2 * 8314.46 * 500 / 6e7, 1e-3);
  EXPECT_EQ(nadal.modulus(molten, 0), 0);
}

TEST(JohnsonCook, GivesTheYieldStressOfCopper) {
  // (90 + 292 0.3^0.31) MPa = 291.043 MPa; times 1 + 0.025 ln 1e4 = 1.230259; times 1 - 0.5^1.09 = 0.530239
  const JohnsonCook flow = copper();
  const double halfWay = 0.5 * (298 + 1356);
  EXPECT_NEAR(flow.flowStress({0, 1, 298, 1}), 90e6, 1);
  EXPECT_NEAR(flow.flowStress({0.3, 1, 298, 1}), 291.043e6, 1e3);
  EXPECT_NEAR(flow.flowStress({0.3, 1e4, 298, 1}), 291.043e6 * 1.230259, 1e3);
  EXPECT_NEAR(flow.flowStress({0.3, 1e4, halfWay, 1}), 291.043e6 * 1.230259 * 0.530239, 1e3);
  EXPECT_EQ(flow.flowStress({0.3, 1e4, 1400, 1}), 0);
}

TEST(JohnsonCook, HardensAsItsYieldStressGrows) {
  const JohnsonCook flow = copper();
  const double h = 1e-5,
               slope = (flow.flowStress({0.3 + h, 50, 400, 1}) - flow.flowStress({0.3 - h, 50, 400, 1})) / (2 * h);
  EXPECT_NEAR(flow.hardening({0.3, 50, 400, 1}), slope, 1e-8 * slope);
}

TEST(SteinbergCochranGuinan, GivesTheYieldStressOfCopper) {
  // OFHC, half hard, of table 1 of the paper: 120 MPa (1 + 36 0.3)^0.45 = 364.358 MPa; at most 640 MPa
  const SteinbergCochranGuinan flow{47.7e9, 120e6, 640e6, 36, 0.45, 0};
  EXPECT_NEAR(flow.flowStress({0.3, 1, 300, 47.7e9}), 364.358e6, 1e4);
  EXPECT_NEAR(flow.flowStress({0.3, 1, 300, 2 * 47.7e9}), 2 * 364.358e6, 2e4);
  EXPECT_EQ(flow.flowStress({9, 1, 300, 47.7e9}), 640e6);
  const double h = 1e-5;
  const double slope =
      (flow.flowStress({0.3 + h, 1, 300, 47.7e9}) - flow.flowStress({0.3 - h, 1, 300, 47.7e9})) / (2 * h);
  EXPECT_NEAR(flow.hardening({0.3, 1, 300, 47.7e9}), slope, 1e-7 * slope);
}

TEST(SteinbergCochranGuinan, GivesShearModulusAndMeltingTemperatureUnderPressure) {
  // Copper of the same table, 20 GPa, a tenth denser, 400 K: 1 + 2.83e-11 2e10/1.1^(1/3) - 3.77e-4 100 = 1.510601;
  // exp(3 (1 - 1/1.1)) 1.1^(2 (2.02 - 1.5 - 1/3)) = 1.361123
  const Compression compression{20e9, 1.1, 400};
  EXPECT_NEAR((ScgShear{47.7e9, 2.83e-11, 3.77e-4}.modulus(compression, 0)), 47.7e9 * 1.510601, 1e5);
  EXPECT_NEAR((ScgMelting{1790, 2.02, 1.5}.temperature(compression, 0)), 1790 * 1.361123, 1e-2);
}

TEST(ZerilliArmstrong, GivesTheYieldStressOfCopper) {
  // OFHC of the paper: 65 MPa + 890 MPa 0.3^(1/2) exp(-0.0028 300) = 275.45 MPa at a rate of 1/s
  const ZerilliArmstrong flow{65e6, 0, 890e6, 0, 1, 0.0028, 0.000115, 0, 0};
  const auto yieldStress = [&](double rate) { return flow.flowStress({0.3, 1e6, 300, 1, 0, 0, rate}); };
  EXPECT_NEAR(yieldStress(1), 275.45e6, 1e4);
  EXPECT_NEAR(std::log((yieldStress(1e3) - 65e6) / (yieldStress(1) - 65e6)), 0.000115 * std::log(1e3) * 300, roundOff)
      << "by the rate of the plastic strain, not of the whole";
}

/// Rudnicki & Rice, J. Mech. Phys. Solids 23 (1975) 371: bands form at h = -(1 + nu)/2 N^2 G, N the middle principal
/// stress over the shear stress, here 0 and 3^(-1/2); H = 3 h.
TEST(ZerilliArmstrong, HardensAtAConstantRateAsItsFormulaSays) {
  ZerilliArmstrong model;
  model.c0 = 65e6;
  model.b0 = 890e6;
  model.alpha0 = 0.0028;
  model.alpha1 = 0.000115;
  model.k = 100e6;
  model.n = 0.5;
  FlowState state{};
  state.plasticStrain = 0.1;
  state.plasticStrainRate = 1e3;
  state.temperature = 300;
  const double fading = std::exp(-(0.0028 - 0.000115 * std::log(1e3)) * 300);
  const double exact = 0.5 * (890e6 * fading + 100e6) / std::sqrt(0.1);
  EXPECT_NEAR(hardeningAtRate(model, state), exact, 1e-6 * exact);
}

TEST(StabilityCheck, ShearBandsFormAtTheHardeningOfRudnickiAndRice) {
  const double bulk = 2, shear = 1, nu = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
  const double small = 1e-8;  // of stresses: their effect on the threshold is of its size or less
  const auto fails = [&](const Vec3& stress, double hardening) {
    return BeckerCheck().fails({bulk, shear, hardening}, small * stress.asDiagonal(), Matrix3::Zero());
  };
  const Vec3 shearing(1, 0, -1), tension(1, 0, 0);
  EXPECT_TRUE(fails(shearing, -1e-6));
  EXPECT_FALSE(fails(shearing, 1e-6));
  const double least = -(1 + nu) / 2 * shear;
  EXPECT_TRUE(fails(tension, least - 1e-6));
  EXPECT_FALSE(fails(tension, least + 1e-6));
}

TEST(StabilityCheck, DruckersNeedsWorkOfTheStressRate) {
  const Matrix3 stress = Vec3(1, 0, -1).asDiagonal(), along = 7 * stress, across = Vec3(1, -2, 1).asDiagonal();
  const auto fails = [&](double hardening, const Matrix3& rate) {
    return DruckerCheck().fails({2, 1, hardening}, stress, rate);
  };
  EXPECT_TRUE(fails(-1e-6, along));
  EXPECT_FALSE(fails(1e-6, along));
  EXPECT_FALSE(fails(-1e-6, across)) << "which is elastic";
  EXPECT_FALSE(fails(-1e-6, along + Matrix3::Identity()));
}

TEST(StabilityCheck, ActsWhereAMetalFlows) {
  Matrix3 sheared = Matrix3::Identity();
  sheared(0, 1) = 0.2;
  const auto isUnstable = [](const ElasticPlasticHp& metal, const Matrix3& f) {
    const MaterialPoint<ElasticPlasticHp> point{metal};
    const auto state = point.state(f);
    return ModelOf<ElasticPlasticHp>(metal).isUnstable(point.step(f), point.stress(f), &state.plasticStrain);
  };
  auto soft = elasticPlastic(IsotropicHardening{0.02, 0}), hard = elasticPlastic(IsotropicHardening{0.02, 0.5});
  EXPECT_FALSE(isUnstable(soft, sheared)) << "without a check";
  soft.stability = hard.stability = DruckerBeckerCheck();
  EXPECT_TRUE(isUnstable(soft, sheared));
  EXPECT_FALSE(isUnstable(hard, sheared));
  EXPECT_FALSE(isUnstable(soft, Matrix3::Identity() + 1e-3 * (sheared - Matrix3::Identity()))) << "still elastic";
}

/// Conservation of momentum, mass and energy across a shock: p = rho_0 U u, eta = u/U, e = u²/2, U = C_0 + S u.
TEST(MieGruneisen, GivesTheShockRelation) {
  MieGruneisenEnergy copper;
  copper.soundSpeed = 3940;
  copper.gruneisen = 2.02;
  copper.s1 = 1.489;
  for (const double u : {10.0, 300.0, 1500.0}) {
    const double shock = copper.soundSpeed + copper.s1 * u, pressure = 8930 * shock * u;
    VolumeState state{};
    state.volume = 1 - u / shock;
    state.energy = u * u / 2;
    state.density = 8930;
    EXPECT_NEAR(-copper.meanStress(state), pressure, roundOff * pressure);
  }
}

TEST(MieGruneisen, ByTemperatureAgreesWithThatByEnergy) {
  MieGruneisen byTemperature{3940, 2.02, 1.489};
  MieGruneisenEnergy byEnergy{3940, 2.02, 1.489, 0, 0};
  VolumeState state{};
  state.volume = 0.8;
  state.temperature = 500;
  state.initialTemperature = 300;
  state.specificHeat = 383;
  state.energy = 383 * 200;
  state.density = 8930;
  EXPECT_NEAR(byTemperature.meanStress(state), byEnergy.meanStress(state), -roundOff * byEnergy.meanStress(state));
  state.dilatation = -0.01;  // compression heats: dT = -T Gamma_0 J tr D dt
  EXPECT_NEAR(byTemperature.heating(state), 500 * 2.02 * 0.8 * 0.01, 1e-12);
  EXPECT_EQ(byTemperature.heating(state), byEnergy.heating(state));
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
