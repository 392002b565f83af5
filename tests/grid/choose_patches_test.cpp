#include "core/grid/choose_patches.hpp"

#include <gtest/gtest.h>

namespace tushar::grid {

namespace {
int countOf(const Index3& patches) { return patches[0] * patches[1] * patches[2]; }
}  // namespace

TEST(ChoosePatches, MakesAsManyAsAreWantedOrAQuarterMore) {
  for (const Index3& cells : {Index3{{1000, 1, 1}}, Index3{{300, 200, 1}}, Index3{{64, 50, 40}}})
    for (int count = 1; count <= 200; ++count) {
      const int made = countOf(choosePatches(cells, count));
      EXPECT_GE(made, count);
      EXPECT_LE(made, count + count / 4);
    }
}

TEST(ChoosePatches, HasFewGhostsButKeepsRowsLong) {
  EXPECT_EQ(choosePatches({{64, 64, 64}}, 8), (Index3{{1, 2, 4}}));
  EXPECT_EQ(choosePatches({{64, 64, 64}}, 2), (Index3{{1, 1, 2}}));
  EXPECT_EQ(choosePatches({{64, 64, 64}}, 64), (Index3{{2, 4, 8}}));
  EXPECT_EQ(choosePatches({{100, 100, 1}}, 16), (Index3{{2, 8, 1}}));
  EXPECT_EQ(choosePatches({{1600, 100, 1}}, 16), (Index3{{8, 2, 1}}));
  EXPECT_EQ(choosePatches({{1600, 1, 1}}, 16), (Index3{{16, 1, 1}}));
}

TEST(ChoosePatches, MakesMoreThanAreWantedOnlyIfThisPaysOffForTheWorkerThatHasOneMore) {
  EXPECT_EQ(countOf(choosePatches({{57, 57, 57}}, 8)), 8) << "nine would have fewer ghosts";
  EXPECT_EQ(choosePatches({{64, 64, 64}}, 7), (Index3{{1, 2, 4}})) << "seven planes would have many";
}

TEST(ChoosePatches, MakesNoMoreAlongAnAxisThanThereAreCells) {
  EXPECT_EQ(choosePatches({{5, 1, 1}}, 100), (Index3{{5, 1, 1}}));
  EXPECT_EQ(choosePatches({{3, 2, 1}}, 6), (Index3{{3, 2, 1}}));
}

TEST(ParseLayout, TakesThreeWholeNumbersFromOneOnAndNothingElse) {
  EXPECT_EQ(parseLayout("4x2x1"), (Index3{{4, 2, 1}}));
  for (const char* nonsense :
       {"", "4", "4x2", "4x2x", "4x2x0", "4x-2x1", "4x2x1x1", "4 x2x1", "axbxc", "4x2x1.5", "4x2x99999999999"})
    EXPECT_EQ(parseLayout(nonsense), std::nullopt) << nonsense;
}

TEST(Workers, AreFewerWhereThereIsLittleToDoUnlessTheirNumberIsGiven) {
  const Workers few{4, true, 1, {}}, given{4, false, 1, {}};

  EXPECT_EQ(few.threadsFor({{100, 1, 1}}), 1);
  EXPECT_EQ(few.threadsFor({{1000, 1000, 1}}), 4);
  EXPECT_EQ(given.threadsFor({{100, 1, 1}}), 4);
}

TEST(Workers, GetSeveralPatchesEachAndOneWorkerGetsOne) {
  EXPECT_EQ(Workers{}.patchesFor({{1000, 1000, 1}}), 1);
  EXPECT_GT((Workers{4, false, 1, {}}.patchesFor({{1000, 1000, 1}})), 4);
  EXPECT_GT((Workers{1, false, 3, {}}.patchesFor({{1000, 1000, 1}})), 3);
  EXPECT_EQ((Workers{4, false, 1, {}}.patchesFor({{2, 1, 1}})), 2);
}

}  // namespace tushar::grid
