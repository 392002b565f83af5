#include "core/scene/dry_run.hpp"

#include <gtest/gtest.h>

#include "components/components.hpp"

namespace tushar::scene {

namespace {

/// Returns the dry run of a cube of `width`³ patches of 4³ cells, with eight patches per rank.
DryRun ofCube(const std::string& scene, int width) {
  const std::string cells = std::to_string(4 * width), patches = std::to_string(width);
  return dryRun(scene,
                {"Grid/Level/Box/resolution=[" + cells + "," + cells + "," + cells + "]",
                 "Grid/Level/Box/patches=[" + patches + "," + patches + "," + patches + "]"},
                catalogue(), {1, false, width * width * width / 8, {}});
}

}  // namespace

TEST(DryRun, FindsThatARankHasAsMuchToDoAmongManyAsAmongFew) {
  for (const char* scene : {"ups/euler/vortex_3d.ups", "ups/mpm/vortex_3d.ups"}) {
    const DryRun few = ofCube(scene, 8), many = ofCube(scene, 64);

    EXPECT_EQ(many.ranks, 32768);
    EXPECT_EQ(many.patchesOfAll, 262144);
    EXPECT_EQ(many.patches, 8);
    EXPECT_EQ(many.neighbours, 26);
    EXPECT_EQ(many.placements, few.placements);
    EXPECT_EQ(many.messages, few.messages);
    EXPECT_EQ(many.bytes, few.bytes);
    EXPECT_GT(many.messages, 0);
  }
}

TEST(DryRun, HasAtMostTwiceTheMessagesAmongAMillionPatchesThatDivideBadly) {
  for (const char* scene : {"ups/euler/vortex_3d.ups", "ups/mpm/vortex_3d.ups"}) {
    const DryRun even = ofCube(scene, 8), uneven = ofCube(scene, 100);

    EXPECT_EQ(uneven.ranks, 125000);
    EXPECT_EQ(uneven.patches, 8);
    EXPECT_LE(uneven.messages, 2 * even.messages);
    EXPECT_LE(uneven.bytes, 2 * even.bytes);
  }
}

TEST(DryRun, CountsWhatAllRanksAgreeOn) {
  // Time step (unless nothing limits it), step and clock; and once more for each material in a relocation, for each
  // solve and for saved totals.
  const auto agreements = [](const char* scene) {
    return dryRun(scene, {}, catalogue(), {1, false, 2, {}}).agreements;
  };

  EXPECT_EQ(agreements("ups/euler/sod.ups"), 3);
  EXPECT_EQ(agreements("ups/heat/sine.ups"), 4);
  EXPECT_EQ(agreements("ups/heat/implicit.ups"), 4);
  EXPECT_EQ(agreements("ups/mpm/sod.ups"), 5);
}

TEST(DryRun, HasNoMessagesOnOneRank) {
  const DryRun alone = dryRun("ups/euler/sod.ups", {"Grid/Level/Box/patches=[7,1,1]"}, catalogue(), {});

  EXPECT_EQ(alone.patches, 7);
  EXPECT_EQ(alone.messages, 0);
}

TEST(DryRun, SaysWhatItDoesNotCountOfGridsOfSeveralLevels) {
  const auto says = [](const DryRun& result, const char* words) {
    return toText(result).find(words) != std::string::npos;
  };
  const DryRun stays, adapts{.isAdaptive = true}, steps{.hasSmallerSteps = true};
  EXPECT_FALSE(says(stays, "criteria refine it"));
  EXPECT_TRUE(says(adapts, "this is the grid before criteria refine it"));
  EXPECT_FALSE(says(adapts, "for one step of all levels"));
  EXPECT_TRUE(says(steps, "for one step of all levels; finer levels take several steps"));
}

}  // namespace tushar::scene
