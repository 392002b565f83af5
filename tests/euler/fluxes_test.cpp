#include "components/euler/fluxes.hpp"

#include <gtest/gtest.h>

#include "tests/euler/gas_box.hpp"

namespace tushar::euler {

namespace {

template <class Flux>
class Fluxes : public testing::Test {};
using BothFluxes = testing::Types<Hllc, ExactFlux>;
TYPED_TEST_SUITE(Fluxes, BothFluxes);

template <class Flux, int D, int Axis = 0>
State<D> fluxBetween(const State<D>& left, const State<D>& right, const Gas& gas = {}) {
  return fluxOf<D, Axis>(Flux::template solve<D, Axis>(gas, left, right));
}

template <int D>
State<D> mirrored(State<D> w) {
  w[kVelocity(0)] = -w[kVelocity(0)];
  return w;
}

/// Expects that values agree to `tolerance`, relative to the largest of them.
template <class S>
void expectNear(const S& found, const S& expected, double tolerance) {
  double size = 0;
  for (const double value : expected) size = std::max(size, std::abs(value));
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], tolerance * size) << "number " << k;
}

}  // namespace

TYPED_TEST(Fluxes, OfEqualStatesIsThatOfTheGas) {
  for (const double u : {-3.0, -0.4, 0.0, 0.7, 2.5}) {
    const State<2> w{1.3, u, -0.6, 0.8};
    const double energy = 0.8 / 0.4 + 0.5 * 1.3 * (u * u + 0.36);
    const State<2> expected{1.3 * u, 1.3 * u * u + 0.8, 1.3 * u * -0.6, (energy + 0.8) * u};
    expectNear(fluxBetween<TypeParam, 2>(w, w), expected, 1e-14);
  }
}

TYPED_TEST(Fluxes, ThroughAContactAtRestIsThePressureAlone) {
  const State<1> flux = fluxBetween<TypeParam, 1>({1, 0, 0.7}, {0.125, 0, 0.7});
  EXPECT_EQ(flux[0], 0);
  EXPECT_EQ(flux[1], 0.7);
  EXPECT_EQ(flux[2], 0);
}

TYPED_TEST(Fluxes, ThroughAMovingContactComesFromUpwind) {
  const State<2> left{1, 0.3, 2, 0.7}, right{0.125, 0.3, -1, 0.7};
  expectNear(fluxBetween<TypeParam, 2>(left, right), fluxBetween<TypeParam, 2>(left, left), 1e-14);
  const State<2> back{0.125, -0.3, 2, 0.7}, fore{1, -0.3, -1, 0.7};
  expectNear(fluxBetween<TypeParam, 2>(back, fore), fluxBetween<TypeParam, 2>(fore, fore), 1e-14);
}

TYPED_TEST(Fluxes, OfSupersonicGasComesFromUpwind) {
  const State<1> left{1, 5, 1}, right{0.5, 4, 0.8};
  expectNear(fluxBetween<TypeParam, 1>(left, right), fluxBetween<TypeParam, 1>(left, left), 1e-14);
}

TYPED_TEST(Fluxes, AtAWallIsThePressureAlone) {
  const State<1> gas{1.2, 0.4, 0.9};
  const State<1> flux = fluxBetween<TypeParam, 1>(gas, mirrored<1>(gas));
  EXPECT_EQ(flux[0], 0);
  EXPECT_GT(flux[1], 0.9);
  EXPECT_EQ(flux[2], 0);
}

TYPED_TEST(Fluxes, AcrossAnotherAxisAreTheSameTurned) {
  const State<2> left{1, 0.2, 0.7, 1}, right{0.4, -0.5, 0.1, 0.3};
  const State<2> turnedLeft{1, 0.7, 0.2, 1}, turnedRight{0.4, 0.1, -0.5, 0.3};
  State<2> flux = fluxBetween<TypeParam, 2, 1>(turnedLeft, turnedRight);
  std::swap(flux[1], flux[2]);
  expectNear(flux, fluxBetween<TypeParam, 2, 0>(left, right), 1e-15);
}

TYPED_TEST(Fluxes, OfAStiffenedGasAreThoseOfAnIdealOneWithTheStiffnessAddedToItsPressure) {
  const Gas stiff{4.4, 6};
  const State<1> left{1, 0.2, 4}, right{0.7, -0.1, -1};
  const State<1> flux = fluxBetween<TypeParam, 1>(left, right, stiff);
  const State<1> ideal = fluxBetween<TypeParam, 1>({1, 0.2, 10}, {0.7, -0.1, 5}, Gas{4.4, 0});
  expectNear(flux, State<1>{ideal[0], ideal[1] - 6, ideal[2]}, 1e-13);
}

TEST(Hllc, MirrorsToTheLastBit) {
  for (double x = 0.01; x < 1; x += 0.0137) {
    const State<3> left = roughGas<3>({x, 0.2, 0.9}), right = roughGas<3>({x, 0.7, 0.1});
    const State<3> flux = fluxBetween<Hllc, 3>(left, right);
    const State<3> mirror = fluxBetween<Hllc, 3>(mirrored<3>(right), mirrored<3>(left));
    EXPECT_EQ(flux[0], -mirror[0]);
    EXPECT_EQ(flux[1], mirror[1]);
    EXPECT_EQ(flux[2], -mirror[2]);
    EXPECT_EQ(flux[3], -mirror[3]);
    EXPECT_EQ(flux[4], -mirror[4]);
  }
}

TEST(Hllc, IsNearTheExactFluxBehindAShock) {
  // A shock of pressure ratio 4.5 (Mach 2) into gas at rest; the exact flux is that of the gas behind it. HLLC bounds
  // its speed from above (Einfeldt), and is therefore a few per cent off.
  const double behind = 8.0 / 3, u = 1.25 * std::sqrt(1.4);
  const State<1> left{behind, u, 4.5}, right{1, 0, 1};
  const State<1> exact = fluxBetween<ExactFlux, 1>(left, right), hllc = fluxBetween<Hllc, 1>(left, right);
  expectNear(exact, fluxBetween<ExactFlux, 1>(left, left), 1e-13);
  expectNear(hllc, exact, 0.03);
}

TEST(ExactFlux, OfSodsTubeIsThatOfTheStateAtTheDiaphragm) {
  const double p = 0.30313017805064707, u = 0.92745262004895057, rho = 0.42631942817849544;
  const State<1> expected{rho * u, rho * u * u + p, (p / 0.4 + 0.5 * rho * u * u + p) * u};
  expectNear(fluxBetween<ExactFlux, 1>({1, 0, 1}, {0.125, 0, 0.1}), expected, 1e-12);
}

TEST(Gas, RecoversWhatItConserves) {
  const Gas gas{4.4, 6};
  const State<3> w{2, 0.3, -0.4, 0.5, -1};
  expectNear(primitive<3>(gas, conserved<3>(gas, w)), w, 1e-14);
}

TEST(Gas, IsIdealWithoutStiffness) {
  const Gas gas{1.4, 0};
  EXPECT_DOUBLE_EQ(gas.pressure(2, 2.5), 1);
  EXPECT_DOUBLE_EQ(gas.energyOf(2, 1), 2.5);
  EXPECT_DOUBLE_EQ(gas.soundSpeedSquared(2, 3), 2.1);
}

}  // namespace tushar::euler
