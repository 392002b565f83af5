#include "components/euler/interpolate_gas.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/euler/transferred.hpp"

namespace tushar::euler {

TEST(GasInterpolation, GivesAllFinerCellsTheStateOfTheirCoarseOneIfOneIsImpossible) {
  const GasInterpolation<2> how(Gas{}, {});
  Transferred<2> at(how.variables());
  at.coarse[0][at.parent()] = at.coarse[2][at.parent()] = 1;
  at.coarse[1][2 * at.parent()] = 0.5;
  at.fine = {{1, 1, 1, 1}, {0, 0, 0, 0, 0, 0, 2, 0}, {1, 1, 1, 1}};  // the last one has no pressure

  at.correct(how);

  EXPECT_EQ(at.fine[0], std::vector<double>(4, 1));
  EXPECT_EQ(at.fine[1], (std::vector<double>{0.5, 0, 0.5, 0, 0.5, 0, 0.5, 0}));
  at.fine[0] = {0.5, 1.5, 0.75, 1.25};
  at.correct(how);
  EXPECT_EQ(at.fine[0], (std::vector<double>{0.5, 1.5, 0.75, 1.25})) << "possible states stay";
}

TEST(GasInterpolation, KeepsACarriedQuantityInItsRange) {
  const CellLabel<double> held("c.held", "1", "a carried quantity times the density");
  const GasInterpolation<2> how(Gas{}, {&held});
  Transferred<2> at(how.variables());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0, 1);
  for (int turn = 0; turn < 1000; ++turn) {
    std::vector<double> f;
    for (std::size_t cell = 0; cell < at.cells.size(); ++cell) {
      f.push_back(number(random));
      at.coarse[0][cell] = 0.1 + number(random);
      at.coarse[2][cell] = 10;
      at.coarse[3][cell] = f[cell] * at.coarse[0][cell];
    }
    const double below = 0.09 * number(random), above = 0.09 * number(random), rho = at.coarse[0][at.parent()];
    at.fine[0] = {rho - above, rho - below, rho + below, rho + above};
    at.fine[2] = std::vector<double>(4, 10);
    at.correct(how);
    const auto [least, most] = std::minmax({f[1], f[3], f[4], f[5], f[7]});
    for (std::size_t cell = 0; cell < 4; ++cell) {
      EXPECT_GE(at.fine[3][cell] / at.fine[0][cell], least - 1e-14);
      EXPECT_LE(at.fine[3][cell] / at.fine[0][cell], most + 1e-14);
    }
    EXPECT_NEAR(mean(at.fine[3]), at.coarse[3][at.parent()], 1e-15);
  }
}

}  // namespace tushar::euler
