#include "core/grid/choose_patches.hpp"
#include "tests/scene/read_levels.hpp"

namespace tushar::scene {
namespace {

const std::string channel = box("-1,0,0", "1,.5,0", "32,8,1");

Strings problemsOf(const std::string& second) { return read(level(channel + second)).problems; }

TEST(BoxesOfALevel, LieInTheirBoundingBox) {
  const Read found = read(level(channel + box("-.25,-1,0", ".25,0,0", "8,16,1")));

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.domain.lower, Vec3(-1, -1, 0));
  EXPECT_EQ(found.domain.upper, Vec3(1, .5, 0));
  EXPECT_EQ(found.domain.resolution, (Index3{{32, 24, 1}}));
  ASSERT_EQ(found.domain.boxes.size(), 2U);
  EXPECT_EQ(found.domain.boxes[0], (grid::Box{{{0, 16, 0}}, {{32, 24, 1}}}));
  EXPECT_EQ(found.domain.boxes[1], (grid::Box{{{12, 0, 0}}, {{20, 16, 1}}}));
}

TEST(BoxesOfALevel, MayHaveTheirCellsBySpacing) {
  const Read found = read(
      "<Level><Box><lower>[0,0,0]</lower><upper>[1,.5,0]</upper></Box>"
      "<Box><lower>[0,.5,0]</lower><upper>[.25,1,0]</upper></Box><spacing>[.125,.25,1]</spacing></Level>");

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.domain.resolution, (Index3{{8, 4, 1}}));
  ASSERT_EQ(found.domain.boxes.size(), 2U);
  EXPECT_EQ(found.domain.boxes[1], (grid::Box{{{0, 2, 0}}, {{2, 4, 1}}}));
}

TEST(BoxesOfALevel, AreOneBoxIfTheyFillIt) {
  const Read found = read(level(channel + box("-1,.5,0", "0,1,0", "16,8,1") + box("0,.5,0", "1,1,0", "16,8,1")));

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_TRUE(found.domain.boxes.empty());
  EXPECT_EQ(found.domain.upper, Vec3(1, 1, 0));
  EXPECT_EQ(found.domain.resolution, (Index3{{32, 16, 1}}));
}

TEST(BoxesOfALevel, AreDividedTogether) {
  const Read found = read(level(box("-1,0,0", "1,.5,0", "32,8,1", "<patches>[3,1,1]</patches>") +
                                box("-1,.5,0", "0,1,0", "16,8,1", "<autoPatch>5</autoPatch>")));

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.domain.patches, grid::choosePatches({{32, 16, 1}}, 8));
  EXPECT_EQ(found.notes, (Strings{"Grid/Level/Box: the boxes of a Level are divided together, into about 8 patches"}));
}

TEST(BoxesOfALevel, AreDividedAsForOneIfOneRequestsNothing) {
  grid::Workers workers;
  workers.threads = 6;
  const Read found =
      read(level(box("-1,0,0", "1,.5,0", "32,8,1", "<patches>[3,1,1]</patches>") + box("-1,.5,0", "0,1,0", "16,8,1")),
           "", workers);

  EXPECT_EQ(found.domain.patches, grid::choosePatches({{32, 16, 1}}, workers.patchesFor({{32, 16, 1}})));
  EXPECT_EQ(found.notes, Strings{});
}

TEST(BoxesOfALevel, HaveCellsOfOneSizeAtTheSamePlaces) {
  EXPECT_EQ(problemsOf(box("-1,.5,0", "0,1,0", "16,4,1")),
            (Strings{"Grid/Level/Box: its cells are 0.125 m wide along y, but those of the first Box, at s.ups:1:37, "
                     "0.0625 m; all boxes of a Level have cells of one size"}));
  EXPECT_EQ(problemsOf(box("-.97,.5,0", ".03,1,0", "16,8,1")),
            (Strings{"Grid/Level/Box: its lower corner is 0.03 m from that of the first Box along x, at s.ups:1:37; "
                     "expected a multiple of the cell width, 0.0625 m"}));
  EXPECT_EQ(problemsOf(box("-1,.5,1", "0,1,1", "16,8,1")),
            (Strings{"Grid/Level/Box: its lower corner is 1 m from that of the first Box along z, at s.ups:1:37; "
                     "expected a multiple of the cell width, 0 m"}));
}

TEST(BoxesOfALevel, ShareFacesAndDoNotOverlap) {
  EXPECT_EQ(problemsOf(box("-1,.25,0", "0,1,0", "16,12,1")),
            (Strings{"Grid/Level/Box: overlaps the Box at s.ups:1:37"}));
  EXPECT_EQ(problemsOf(box("-1,.625,0", "0,1,0", "16,6,1")),
            (Strings{"Grid/Level/Box: is apart from the Box at s.ups:1:37: no chain of boxes that share faces of cells "
                     "leads from one to the other"}));
  EXPECT_EQ(problemsOf(box("-1,.5,0", "0,1,0", "16,8,1") + box(".125,.5,0", "1,1,0", "14,8,1")),
            (Strings{"Grid/Level/Box: comes too close to the Box at s.ups:1:127: wide shape functions would reach from "
                     "one into the other; between boxes that share no faces, leave at least 3 cells"}));
}

TEST(BoxesOfALevel, AreNeitherPeriodicNorRefined) {
  const std::string shaft = box("-1,.5,0", "0,1,0", "16,8,1");

  EXPECT_EQ(problemsOf(shaft + "<periodic>[1,0,0]</periodic>"),
            (Strings{"Grid/Level/periodic: found [1,0,0], expected [0,0,0]: a Level of several boxes cannot be "
                     "periodic"}));
  EXPECT_EQ(read(level(channel + shaft) + level(box("-1,0,0", "0,.5,0", "32,16,1"))).problems,
            (Strings{"Grid/Level/Box: a grid of several levels needs one Box in its first Level"}));
}

}  // namespace
}  // namespace tushar::scene
