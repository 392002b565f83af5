#include <gtest/gtest.h>

#include "components/mpm/solid/tasks/create_particles.hpp"
#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {
namespace {

// Composition B in cm, g and microseconds (pressures in Mbar), after Hornberg, Propellants, Explos., Pyrotech. 11
// (1986) 23.
constexpr double density = 1.717, velocity = 0.798;
const Jwl products{4.96376, 0.03944, 0.01288, 4.06244, 0.94846, 0.35};
const Murnaghan explosive{39, 7.4};

ProgramBurn programmed() {
  ProgramBurn model;
  model.compressibility = explosive.compressibility;
  model.exponent = explosive.exponent;
  std::tie(model.a, model.b, model.c) = std::tuple(products.a, products.b, products.c);
  std::tie(model.r1, model.r2, model.omega) = std::tuple(products.r1, products.r2, products.omega);
  model.density = density;
  model.detonationVelocity = velocity;
  return model;
}

JwlppMpm reactive(double rate, double power) {
  JwlppMpm model;
  model.compressibility = explosive.compressibility;
  model.exponent = explosive.exponent;
  std::tie(model.a, model.b, model.c) = std::tuple(products.a, products.b, products.c);
  std::tie(model.r1, model.r2, model.omega) = std::tuple(products.r1, products.r2, products.omega);
  model.material.density = density;
  model.ignitionPressure = 1e-3;
  model.rate = rate;
  model.power = power;
  return model;
}

template <class Law>
void expectStiffnessOf(const Law& law) {
  for (const double j : {0.7, 1.0, 2.5}) {
    constexpr double h = 1e-4;
    const double slope = (law.pressure(j + h) - law.pressure(j - h)) / (2 * h);
    EXPECT_NEAR(-slope / law.stiffness(j), 1, 1e-5) << "differences of second order, h^2 n^2 of it";
  }
}

TEST(Explosive, HasTheStiffnessOfItsPressure) {
  expectStiffnessOf(products);
  expectStiffnessOf(explosive);
  EXPECT_NEAR(explosive.pressure(explosive.relativeVolume(0.1)), 0.1, 1e-14);
}

/// At the state of Chapman and Jouguet the Rayleigh line p = rho_0 D² (1 - V) touches the isentrope of the products.
TEST(Explosive, TouchesTheRayleighLineWhereItDetonates) {
  const double steepness = density * velocity * velocity;
  double lower = 0.5, upper = 1;
  for (int k = 0; k < 60; ++k) {
    const double middle = (lower + upper) / 2;
    (products.stiffness(middle) > steepness ? lower : upper) = middle;
  }
  EXPECT_NEAR(products.pressure(lower), 0.295, 1e-4) << "p_CJ, Mbar";
  EXPECT_NEAR(products.pressure(lower) / (steepness * (1 - lower)), 1, 2e-5) << "constants have six digits";
}

double burnedAt(const ProgramBurn& model, double time, const Vec3& position) {
  const Matrix3 f = 0.9 * Matrix3::Identity();
  ProgramBurn::State state = model.initialState();
  const Matrix3 stress = model.updateStress({f, f, Matrix3::Zero(), 1e-3, 0, position, density * 8e-3, time}, f, state);
  const double expected = mixedPressure(explosive, products, state.burned, f.determinant());
  EXPECT_LT((stress + expected * Matrix3::Identity()).norm(), 1e-14 * expected);
  return state.burned;
}

TEST(ProgramBurn, BurnsWhereTheDetonationHasBeen) {
  ProgramBurn model = programmed();
  model.origin = {1, 0, 0};
  model.ignitionTime = 2;
  const double way = Vec3(3, 4, 0).norm(), arrival = 2 + way / velocity, crossing = 1.5 * 0.2 / velocity;
  const Vec3 there(4, 4, 0);
  EXPECT_EQ(burnedAt(model, arrival - 1e-9, there), 0);
  EXPECT_NEAR(burnedAt(model, arrival + 0.5 * crossing, there), 0.5, 1e-12);
  EXPECT_EQ(burnedAt(model, arrival + 0.97 * crossing, there), 1);
  EXPECT_EQ(burnedAt(model, arrival + 100 * crossing, there), 1);
}

/// c² = -J² dp/dJ / rho_0 for each phase; the larger one applies while the particle burns.
TEST(ProgramBurn, HasTheWavesOfTheStifferPartWhileItBurns) {
  const ProgramBurn model = programmed();
  for (const double j : {0.45, 1.0}) {
    const Matrix3 f = std::cbrt(j) * Matrix3::Identity();
    const auto speed = [&](double burned) { return model.waveSpeed(density, {f, f, f, 1, 300}, f, {burned}); };
    const double before = j * std::sqrt(explosive.stiffness(j) / density),
                 after = j * std::sqrt(products.stiffness(j) / density);
    EXPECT_EQ(before > after, j < 0.5) << "the explosive is the stiffer one where it is highly compressed";
    EXPECT_NEAR(speed(0), before, 1e-12);
    EXPECT_NEAR(speed(1), after, 1e-12);
    EXPECT_NEAR(speed(0.5), std::max(before, after), 1e-12);
  }
}

TEST(ProgramBurn, StartsAtAPlaneAndRunsToBothSides) {
  ProgramBurn model = programmed();
  model.origin = {1, 5, 5};
  model.direction = {0, 3, 4};
  const double crossing = 1.5 * 0.2 / velocity;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 there = Vec3(-7, 5, 5) + side * 2 * Vec3(0, 0.6, 0.8);  // 2 away, moved along the plane
    EXPECT_EQ(burnedAt(model, 2 / velocity - 1e-9, there), 0);
    EXPECT_NEAR(burnedAt(model, 2 / velocity + 0.5 * crossing, there), 0.5, 1e-12);
  }
}

/// A material point under pressure at constant volume.
struct Charge {
  explicit Charge(const JwlppMpm& model) : point{model} {
    point.oldDeformation = 0.95 * rotation(0.3);
    const double j = point.oldDeformation.determinant();
    point.oldStress = -explosive.pressure(j) * Matrix3::Identity();
    unburned = explosive.pressure(j);
    burned = products.pressure(j);
  }
  void advance(double time, int steps) {
    point.timeStep = time / steps;
    for (int k = 0; k < steps; ++k) point.advance(Matrix3(rotation(1e-2 * k) * point.oldDeformation));
  }

  MaterialPoint<JwlppMpm> point;
  double unburned, burned;  ///< pressures
};

TEST(JwlppMpm, BurnsLikeADecayWhereTheRateDoesNotDependOnThePressure) {
  Charge charge(reactive(2, 0));
  charge.advance(0.7, 3);
  EXPECT_NEAR(charge.point.oldState.burned, -std::expm1(-2 * 0.7), 1e-8) << "integrated to 1e-9 in each step";
}

/// For b = 1 at constant volume dF/dt = G (1 - F) (p_u + (p_b - p_u) F), so that ln((p_u + (p_b - p_u) F) / (p_u (1 -
/// F))) = G p_b t.
TEST(JwlppMpm, BurnsAsTheSolutionForARateInProportionToThePressure) {
  Charge charge(reactive(10, 1));
  const double time = 1.3;
  charge.advance(time, 2);
  const double growth = charge.unburned * std::exp(10 * charge.burned * time);
  const double expected = (growth - charge.unburned) / (growth + charge.burned - charge.unburned);
  EXPECT_GT(expected, 0.1);
  EXPECT_LT(expected, 0.99);
  EXPECT_NEAR(charge.point.oldState.burned, expected, 1e-8);
}

TEST(JwlppMpm, BurnsNothingBelowTheIgnitionPressureAndNoMoreThanItMay) {
  JwlppMpm model = reactive(1e6, 1);
  model.greatestFraction = 0.8;
  Charge burning(model);
  burning.advance(1, 3);
  EXPECT_EQ(burning.point.oldState.burned, 0.8);
  model.ignitionPressure = 1.0;
  Charge cold(model);
  cold.advance(1, 3);
  EXPECT_EQ(cold.point.oldState.burned, 0);
}

TEST(JwlppMpm, StartsUnderThePressureOfTheScene) {
  JwlppMpm model = reactive(1, 1);
  model.startsUnderPressure = true;
  model.initialPressure = 0.01;
  Material material;
  material.density = model.material.density;
  material.model = std::make_shared<ModelOf<JwlppMpm>>(model);
  const double ratio = material.model->initialVolumeRatio();
  EXPECT_LT(ratio, 1);
  EXPECT_EQ(material.undeformedDensity(), material.density * ratio) << "it fills its body so compressed";
  std::vector<double> state(static_cast<std::size_t>(material.model->stateSize()));
  material.model->initialize(state.data(), {});
  const Matrix3 stress = startStress(material, std::cbrt(ratio) * Matrix3::Identity(), 300, state.data());
  EXPECT_LT((stress + 0.01 * Matrix3::Identity()).norm(), 1e-15);
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
