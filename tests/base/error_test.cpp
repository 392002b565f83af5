#include "core/base/error.hpp"

#include <gtest/gtest.h>

namespace tushar {

TEST(Counted, HasAPluralBeyondOne) {
  EXPECT_EQ(counted(1, "cell"), "1 cell");
  EXPECT_EQ(counted(0, "cell"), "0 cells");
  EXPECT_EQ(counted(218, "step"), "218 steps");
}

TEST(AllOf, JoinsWithAndWhatAlternativesJoinWithOr) {
  EXPECT_EQ(allOf({"gas"}), "'gas'");
  EXPECT_EQ(allOf({"a", "b", "c"}), "'a', 'b' and 'c'");
  EXPECT_EQ(alternatives({"a", "b", "c"}), "'a', 'b' or 'c'");
}

TEST(PlaceOf, IsTheOptionThatOverridesAPart) {
  const Location tag{"a.ups", 3, 5}, part{"a.ups", 4, 7}, option{"--set a/b=1", 0, 0}, unknown;
  EXPECT_EQ(placeOf({&part, &option}, tag).text(), "--set a/b=1");
  EXPECT_EQ(placeOf({&part, &unknown}, tag).text(), "a.ups:3:5");
}

TEST(DidYouMean, CountsExchangedNeighboursAsOneMistake) {
  EXPECT_EQ(didYouMean("mmp", {"impm", "mpm", "mpmice"}), " (did you mean 'mpm'?)");
  EXPECT_EQ(didYouMean("tpye", {"time", "type"}), " (did you mean 'type'?)");
  EXPECT_EQ(didYouMean("densty", {"density", "velocity"}), " (did you mean 'density'?)");
  EXPECT_EQ(didYouMean("quux", {"density", "velocity"}), "");
}

}  // namespace tushar
