#include "components/euler/interpolate_mixture.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/euler/transferred.hpp"

namespace tushar::euler {

namespace {

/// Fractions of three gases that vary along all axes and at random, and their masses at fixed densities of the gases.
template <int D>
void expectUniform(const std::vector<Settings>& gases, double p, const Vec<D>& v, double roundOff) {
  const MixtureInterpolation<D> how(gases);
  Transferred<D> at(how.variables());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(0, 0.02);
  std::size_t place = 0;
  grid::forEach<3>(at.cells, [&](const Index3& index) {
    double x = 0;
    for (int d = 0; d < D; ++d) x += 0.03 * (d + 1) * index[d];
    const std::array<double, 3> parts{0.3 + x + noise(random), 0.3 - 0.3 * x + noise(random), 0.4 + noise(random)};
    MixedGas law;
    for (std::size_t k = 0; k < 3; ++k) {
      const double share = parts[k] / (parts[0] + parts[1] + parts[2]), own = std::pow(10.0, k);
      at.coarse[3 + 2 * k][place] = share * own;
      at.coarse[4 + 2 * k][place] = share;
      at.coarse[0][place] += share * own;
      law.add(share, gases[k].gas.gamma, gases[k].gas.pInfinity);
    }
    for (int d = 0; d < D; ++d) at.coarse[1][place * D + d] = v[d] * at.coarse[0][place];
    at.coarse[2][place] = law.energyOf(0, p) + 0.5 * v.squaredNorm() * at.coarse[0][place];
    ++place;
  });
  at.correct(how);
  for (std::size_t cell = 0; cell < at.finer.size(); ++cell) {
    MixedGas law;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      law.add(at.fine[4 + 2 * k][cell], gases[k].gas.gamma, gases[k].gas.pInfinity);
      sum += at.fine[4 + 2 * k][cell];
      EXPECT_NEAR(at.fine[3 + 2 * k][cell] / at.fine[4 + 2 * k][cell], std::pow(10.0, k), 1e-12 * std::pow(10.0, k));
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    for (int d = 0; d < D; ++d) EXPECT_NEAR(at.fine[1][cell * D + d] / at.fine[0][cell], v[d], 1e-13);
    EXPECT_NEAR(law.pressure(0, at.fine[2][cell] - 0.5 * v.squaredNorm() * at.fine[0][cell]), p, roundOff);
  }
  for (const std::size_t one : {0, 2, 3, 4, 5, 6, 7, 8})
    EXPECT_NEAR(mean(at.fine[one]), at.coarse[one][at.parent()], 1e-14 * std::abs(at.coarse[one][at.parent()]));
  EXPECT_GT(std::abs(at.fine[4][0] - at.fine[4].back()), 1e-4);  // there are slopes
}

std::vector<Settings> threeGases() {
  std::vector<Settings> gases(3);
  gases[1].gas = {.gamma = 4.4, .pInfinity = 6e8};
  gases[2].gas = {.gamma = 3, .pInfinity = 3e8};
  return gases;
}

}  // namespace

TEST(MixtureInterpolation, KeepsUniformPressureAndVelocity) {
  std::vector<Settings> gases = threeGases();
  expectUniform<1>(gases, 1e5, Vec<1>(300), 1e-5);
  expectUniform<2>(gases, 1e5, Vec<2>(300, -20), 1e-5);
  expectUniform<3>(gases, 1e5, Vec<3>(300, -20, 1), 1e-5);
  for (Settings& gas : gases) gas.gas.pInfinity = 0;
  expectUniform<2>(gases, 1, Vec<2>(0.5, 0), 1e-13);
}

TEST(MixtureInterpolation, KeepsFractionsAndMassesAbove0) {
  const std::vector<Settings> gases = threeGases();
  const MixtureInterpolation<2> how(gases);
  Transferred<2> at(how.variables());
  for (std::size_t cell = 0; cell < at.cells.size(); ++cell) {
    const double share = cell % 3 == 0 || cell < 3 ? 0 : cell == 8 ? 0.9 : 0.1;  // a corner filled by the first gas
    for (const std::size_t one : {3, 4}) at.coarse[one][cell] = share;
    for (const std::size_t one : {5, 6}) at.coarse[one][cell] = 1 - share;
    at.coarse[0][cell] = 1;
    at.coarse[2][cell] = 3e9;
  }
  at.correct(how);
  for (std::size_t cell = 0; cell < at.finer.size(); ++cell)
    for (std::size_t one = 3; one < 9; ++one) EXPECT_GE(at.fine[one][cell], 0);
}

}  // namespace tushar::euler
