#include "components/euler/tasks/mend_new_cells.hpp"

#include <gtest/gtest.h>

#include "tests/euler/gas_box.hpp"

namespace tushar::euler {

namespace {

/// A gas at rest on 4 x 4 cells with 2.5 J/m³, that is a pressure of 1 Pa.
struct Plate {
  Grid grid{closedBox(2, 4)};
  std::vector<double> density = std::vector<double>(16, 1), energy = std::vector<double>(16, 2.5);
  std::vector<Vec<2>> momentum = std::vector<Vec<2>>(16, Vec<2>(0, 0));

  void mend(const std::vector<Box>& cells) {
    const Box& all = grid.level().cells();
    mendNewCells<2>(grid.patches().front(), Gas{}, cells,
                    {{CellView<double>(density.data(), all), CellView<Vec<2>>(momentum.data(), all),
                      CellView<double>(energy.data(), all)}});
  }
};

}  // namespace

TEST(MendNewCells, GivesAllChildrenOfAParentTheirMeanIfOneHasNoPressure) {
  Plate plate;
  for (const int child : {0, 1, 4, 5}) plate.density[child] = child == 5 ? 1.75 : 0.75;
  plate.momentum[5] = Vec<2>(4, 0);  // takes 8 / 1.75 of its 2.5 J/m³
  plate.energy[2] = 7;

  plate.mend({{{{0, 0, 0}}, {{4, 4, 1}}}});

  for (const int child : {0, 1, 4, 5}) {
    EXPECT_EQ(plate.density[child], 1);
    EXPECT_EQ(plate.momentum[child], Vec<2>(1, 0));
    EXPECT_EQ(plate.energy[child], 2.5);
  }
  EXPECT_EQ(plate.energy[2], 7);  // of another parent
  EXPECT_EQ(plate.energy[3], 2.5);
}

TEST(MendNewCells, LeavesOtherCellsAlone) {
  Plate plate;
  plate.energy[15] = -1;

  plate.mend({{{{0, 0, 0}}, {{2, 4, 1}}}});

  EXPECT_EQ(plate.energy[15], -1);
  EXPECT_EQ(plate.energy[14], 2.5);
}

}  // namespace tushar::euler
