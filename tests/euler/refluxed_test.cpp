#include <gtest/gtest.h>

#include "components/euler/tasks/advance_mixture.hpp"
#include "tests/euler/gas_box.hpp"

namespace tushar::euler {

TEST(Refluxed, CellsBesideFinerOnesAreChecked) {
  const Grid grid(closedBox(2, 4));
  const Box& all = grid.level().cells();
  std::vector<double> density(16, 1), energy(16, 2.5);
  std::vector<Vec<2>> momentum(16, Vec<2>(0, 0));
  const ChangedState<2> state{{CellView<double>(density.data(), all), CellView<Vec<2>>(momentum.data(), all),
                               CellView<double>(energy.data(), all)}};
  const auto check = [&] {
    checkRefluxed<2>(grid.patches().front(), Gas{}, {{{{2, 0, 0}}, {{4, 1, 1}}}, {{{0, 0, 0}}, {{1, 4, 1}}}}, state);
  };
  energy[15] = -1;
  EXPECT_NO_THROW(check());
  density[3] = -1;
  energy[0] = -1;
  try {
    check();
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_EQ(error.cell(), 0U) << "the first cell of all";
  }
}

TEST(Refluxed, FractionsOfGasesAddUpTo1) {
  const Grid grid(closedBox(1, 4));
  const Box& all = grid.level().cells();
  std::vector<double> one{0.25, 0.5, 0.5, 0.5}, other{0.25, 0.75, 0.5, 0.6};
  closeRefluxed<1>(grid.patches().front(), {}, {{{{0, 0, 0}}, {{1, 1, 1}}}, {{{2, 0, 0}}, {{4, 1, 1}}}},
                   {CellView<double>(one.data(), all), CellView<double>(other.data(), all)});
  EXPECT_EQ(one[0], 0.5);
  EXPECT_EQ(one[1], 0.5) << "not beside finer cells";
  EXPECT_EQ(other[1], 0.75);
  EXPECT_DOUBLE_EQ(one[3] + other[3], 1);
}

}  // namespace tushar::euler
