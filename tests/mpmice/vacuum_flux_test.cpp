#include "components/mpmice/vacuum_flux.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tushar::mpmice {

namespace {

constexpr double gammas[] = {1.01, 1.4, 5.0 / 3, 3};

}  // namespace

TEST(FluxIntoVacuum, IsThatOfTheFanOfAGasAtRest) {
  for (const double gamma : gammas) {
    const double c = std::sqrt(gamma * 2 / 0.7), slower = 2 / (gamma + 1);
    const double rho = 0.7 * std::pow(slower, 2 / (gamma - 1)), u = c * slower;
    const double p = 2 * std::pow(slower, 2 * gamma / (gamma - 1));
    const euler::State<2> flux = fluxIntoVacuum<2, 0>({0.7, 0, 0.3, 2}, gamma, 1);
    const double energy = p / (gamma - 1) + 0.5 * rho * (u * u + 0.09);
    const euler::State<2> expected{rho * u, rho * u * u + p, rho * u * 0.3, (energy + p) * u};
    for (std::size_t k = 0; k < flux.size(); ++k) EXPECT_NEAR(flux[k], expected[k], 1e-13 * expected[k]) << gamma;
  }
}

TEST(FluxIntoVacuum, IsThatOfTheGasItselfIfThatIsFasterThanSound) {
  const euler::State<2> flux = fluxIntoVacuum<2, 1>({1, 0.5, -2, 1}, 1.4, -1);
  EXPECT_DOUBLE_EQ(flux[0], -2);
  EXPECT_DOUBLE_EQ(flux[1], -1);
  EXPECT_DOUBLE_EQ(flux[2], 5);
  EXPECT_DOUBLE_EQ(flux[3], -2 * (2.5 + 1 + 0.5 * 4.25));
}

TEST(FluxIntoVacuum, CarriesEachOfSeveralGases) {
  const euler::State<1, 2> gases{2, 0.5, 1.5, 0.4, 1.6, 0.3, 0.7};
  const euler::State<1, 2> flux = fluxIntoVacuum<1, 0, 2>(gases, 1.4, 1);
  const euler::State<1> together = fluxIntoVacuum<1, 0>({2, 0.5, 1.5}, 1.4, 1);
  for (std::size_t k = 0; k < together.size(); ++k) EXPECT_EQ(flux[k], together[k]);
  EXPECT_DOUBLE_EQ(flux[euler::kMass<1>(0)], 0.2 * flux[0]);
  EXPECT_DOUBLE_EQ(flux[euler::kMass<1>(1)], 0.8 * flux[0]);
  EXPECT_DOUBLE_EQ((flux[euler::kShare<1, 2>(0)] / flux[euler::kShare<1, 2>(1)]), 3.0 / 7);
}

TEST(FluxIntoVacuum, IsNothingIfTheGasRecedesFasterThanItExpands) {
  for (const double gamma : gammas) {
    const double escape = 2 / (gamma - 1) * std::sqrt(gamma);
    EXPECT_EQ((fluxIntoVacuum<1, 0>({1, -1.001 * escape, 1}, gamma, 1)), euler::State<1>{});
    EXPECT_EQ((fluxIntoVacuum<1, 0, 2>({1, -1.001 * escape, 1, 0.5, 0.5, 1, 0}, gamma, 1)), (euler::State<1, 2>{}));
    EXPECT_GT((fluxIntoVacuum<1, 0>({1, -0.9 * escape, 1}, gamma, 1))[euler::kDensity], 0);
  }
}

TEST(FluxIntoVacuum, MirrorsToTheLastBit) {
  const euler::State<3> up{1.3, 0.2, 0.3, -0.7, 2.0}, down{1.3, 0.2, 0.3, 0.7, 2.0};
  euler::State<3> mirrored = fluxIntoVacuum<3, 2>(down, 1.4, -1);
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{4}})
    mirrored[k] = -mirrored[k];
  EXPECT_EQ((fluxIntoVacuum<3, 2>(up, 1.4, 1)), mirrored);
}

TEST(FluxIntoVacuum, LeavesInternalEnergyInTheCellThatItFills) {
  for (const double gamma : gammas)
    for (const double speed : {-1.0, 0.0, 1.0, 30.0}) {
      const euler::State<1> flux = fluxIntoVacuum<1, 0>({1, speed, 1}, gamma, 1);
      ASSERT_GT(flux[0], 0);
      EXPECT_GT(flux[2], 0.5 * flux[1] * flux[1] / flux[0]) << "gamma " << gamma << ", speed " << speed;
    }
}

}  // namespace tushar::mpmice
