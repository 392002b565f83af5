#include "tests/scene/read_levels.hpp"

namespace tushar::scene {

TEST(Levels, OneAloneIsCutIntoPatchesAsBefore) {
  const Read found = read(level(box("0,0,0", "1,1,0", "50,7,1", "<patches>[5,1,1]</patches>")));

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.refinement().levels, 1);
  EXPECT_EQ(found.domain.patches, (Index3{{5, 1, 1}}));
  EXPECT_FALSE(found.amr.regrid.adaptive);
}

TEST(Levels, FurtherOnesAreRegionsThatAreAtLeastSoFine) {
  const Read found = read(square + level(box(".5,.25,0", "1,.5,0", "32,16,1") + box("0,0,0", ".5,.25,0", "32,16,1")));

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.notes, Strings{});
  EXPECT_EQ(found.refinement().levels, 2);
  EXPECT_EQ(found.refinement().blockCells[0], 8);
  EXPECT_EQ(found.refinement().blockCells[1], 8);
  ASSERT_EQ(found.refinement().regions.size(), 2u);
  EXPECT_EQ(found.refinement().regions[0].level, 1);
  EXPECT_EQ(found.refinement().regions[0].lower, Vec3(.5, .25, 0));
  EXPECT_EQ(found.refinement().regions[0].upper, Vec3(1, .5, 0));
  EXPECT_EQ(found.refinement().regions[1].upper, Vec3(.5, .25, 0));
}

TEST(Levels, AQuarterOfTheCellWidthIsTwoLevels) {
  const Read found = read(square + level(box(".5,.25,0", "1,.5,0", "64,32,1")));

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.refinement().levels, 3);
  EXPECT_EQ(found.refinement().regions.at(0).level, 2);
}

TEST(Levels, MayBeGivenBySpacing) {
  const Read found = read(square +
                          "<Level><Box><lower>[.5,.25,0]</lower><upper>[1,.5,0]</upper></Box>"
                          "<spacing>[.015625,.015625,1]</spacing></Level>");

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.refinement().regions.at(0).level, 1);
}

TEST(Levels, GrowToWholeBlocksWhichANoteSays) {
  const Read found = read(square + level(box(".5,.3125,0", "1.03125,.5,0", "34,12,1")));

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.notes, (Strings{"Grid/Level/Box: is enlarged to whole blocks: from [0.5,0.25,0] to [1.25,0.5,0] m"}));
}

TEST(Levels, ThatAreNotNestedGetANote) {
  const auto notes = [](const std::string& finest) {
    return read(square + level(box("0,0,0", "1,.5,0", "64,32,1")) + level(finest)).notes;
  };
  const Strings unnested{
      "Grid/Level/Box: is not inside the Boxes of the previous Level; the cells around it are refined as well, so that "
      "levels are nested"};
  EXPECT_EQ(notes(box("0,0,0", "1,.5,0", "128,64,1")), Strings{});
  EXPECT_EQ(notes(box("1,0,0", "1.5,.5,0", "64,64,1")), unnested) << "beside it";
  EXPECT_EQ(notes(box(".5,0,0", "1.5,.5,0", "128,64,1")), unnested) << "half in it";
}

TEST(Levels, WithBoxesThatOverlapGetANote) {
  const auto notes = [](const std::string& second) {
    return read(square + level(box("0,0,0", "1,.5,0", "64,32,1") + second)).notes;
  };
  EXPECT_EQ(notes(box("1,0,0", "2,.5,0", "64,32,1")), Strings{});
  EXPECT_EQ(notes(box(".5,.25,0", "1.5,.75,0", "64,32,1")),
            (Strings{"Grid/Level/Box: overlaps the Box of the same level at s.ups:1:141; the cells that both contain "
                     "are refined once"}));
}

TEST(Levels, LeaveOutAxesThatTheGridDoesNotUse) {
  const std::string walls =
      "<BoundaryConditions><Face side=\"z-\"><BCType label=\"Symmetric\" var=\"symmetry\"/></Face>"
      "<Face side=\"z+\"><BCType label=\"Symmetric\" var=\"symmetry\"/></Face></BoundaryConditions>";
  input::Diagnostics diagnostics;
  const input::Document document = input::documentOf("<Grid>" + walls + level(box("0,0,0", "1,1,1", "32,32,1")) +
                                                     level(box("0,0,0", ".5,.5,1", "32,32,1")) + "</Grid>");
  const grid::Domain domain = readGrid(*document.root().child("Grid"), {{grid::symmetric}}, {}, {}, diagnostics);

  EXPECT_EQ(sentencesOf(diagnostics.sorted()), Strings{});
  EXPECT_EQ(domain.refinement.levels, 2);
}

TEST(Levels, ThatCannotBeGetASentence) {
  const auto refused = [](const std::string& grid) { return read(square + grid).problems; };

  EXPECT_EQ(refused(level(box(".5,.25,0", "1,.5,0", "48,24,1"))),
            (Strings{"Grid/Level/Box: its cells are 3 times smaller along x than those of the first Level; the ratio "
                     "must be 2, 4, 8 or another power of two"}));
  EXPECT_EQ(refused(level(box(".5,.25,0", "1,.5,0", "32,32,1"))),
            (Strings{"Grid/Level/Box: its cells are 2 times smaller along x, but 4 times smaller along y; refine all "
                     "axes equally, and add another Level where one axis needs finer cells"}));
  EXPECT_EQ(refused(level(box(".5,.25,0", "1,.5,0", "16,8,1"))),
            (Strings{"Grid/Level: this Level is not finer than the previous one, at s.ups:1:30; give Levels from "
                     "coarse to fine"}));
  EXPECT_EQ(refused(halved + halved).size(), 1u);
  EXPECT_EQ(
      refused(level(box(".5,.25,0", "2.5,.5,0", "128,16,1"))),
      (Strings{"Grid/Level/Box: found 0.5 to 2.5 m along x, expected a range within the box of the first Level, from 0 "
               "to 2 m"}));
  EXPECT_EQ(refused(level(box(".5,.25,0", ".5,.5,0", "1,16,1"))),
            (Strings{"Grid/Level/Box: the box has no extent along x"}));
  EXPECT_EQ(refused(level(box(".5,.25,0", "1,.5,0", "32,16,2"))),
            (Strings{"Grid/Level/Box: found 2 cells along z, expected 1: the grid does not use this axis"}));
  EXPECT_EQ(refused(level(box(".5,.25,0", "1,.5,0", "32,16,1") + box("0,0,0", ".5,.25,0", "64,32,1"))),
            (Strings{"Grid/Level/Box: its cells are 4 times smaller than those of the first Level, but those of a Box "
                     "above are 2 times smaller; put this Box into a separate Level"}));
  EXPECT_EQ(refused("<Level>" + box(".5,.25,0", "1,.5,0", "32,16,1") + "<periodic>[1,0,0]</periodic></Level>"),
            (Strings{"Grid/Level/periodic: found [1,0,0], but the first Level has [0,0,0]; all Levels must be periodic "
                     "along the same axes"}));
  EXPECT_EQ(refused(level(box("0,0,0", "2,1,0", "4194304,2097152,1"))),
            (Strings{"Grid/Level: its cells are 65536 times smaller than those of the first Level; the largest "
                     "possible ratio is 32768"}));
}

TEST(Levels, RefinedGridsHaveNoPatchesOfTheScene) {
  const Read found = read(level(box("0,0,0", "2,1,0", "64,32,1", "<patches>[2,2,1]</patches>")) +
                          level(box(".5,.25,0", "1,.5,0", "32,16,1", "<autoPatch>4</autoPatch>")));

  EXPECT_EQ(found.problems, Strings{});
  const std::string note =
      ": does nothing: patches of a refined grid are boxes of blocks; --layout sets the largest "
      "number of blocks in a patch";
  EXPECT_EQ(found.notes, (Strings{"Grid/Level/Box/patches" + note, "Grid/Level/Box/autoPatch" + note}));
  EXPECT_FALSE(found.refinement().blocksPerPatch);
}

TEST(Levels, ALayoutIsTheMostBlocksOfAPatch) {
  grid::Workers workers;
  workers.layout = Index3{{2, 1, 2000000000}};

  const Read found = read(square + halved, "", workers);

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.refinement().blocksPerPatch, (Index3{{2, 1, 2}}));
  EXPECT_EQ(found.domain.patches, (Index3{{1, 1, 1}}));
}

TEST(Blocks, AreTheGreatestThatDivideTheResolution) {
  const auto sizes = [](const std::string& upper, const std::string& cells) {
    const Read found = read(level(box("0,0,0", upper, cells)), amr(adaptive, criteria));
    EXPECT_EQ(found.problems, Strings{});
    return found.refinement().blockCells;
  };

  EXPECT_EQ(sizes("1,0,0", "100,1,1")[0], 10);
  EXPECT_EQ(sizes("1,0,0", "64,1,1")[0], 16);
  EXPECT_EQ(sizes("1,1,0", "60,64,1")[0], 6);
  EXPECT_EQ(sizes("1,1,0", "60,64,1")[1], 8);
  EXPECT_EQ(sizes("1,1,1", "24,20,12")[1], 4);
  EXPECT_EQ(sizes("1,1,1", "24,20,12")[2], 6);
  EXPECT_EQ(sizes("1,1,0", "10,64,1")[0], 10);
}

TEST(Blocks, ThatCannotBeGetASentence) {
  const auto refused = [](const std::string& grid, const std::string& regridder) {
    return read(grid, amr(adaptive + regridder, criteria)).problems;
  };
  const auto along = [](const std::string& cells) { return level(box("0,0,0", "1,0,0", cells + ",1,1")); };

  EXPECT_EQ(refused(along("22"), ""),
            (Strings{"Grid/Level/Box: its 22 cells along x cannot be divided into blocks of an even number of cells "
                     "from 4 to 18; choose another <resolution>, or give <min_patch_size> 22"}));
  EXPECT_EQ(refused(along("25"), ""), (Strings{"Grid/Level/Box: its 25 cells along x cannot be divided into blocks of "
                                               "an even number of cells from 4 to 18; choose another <resolution>"}));
  EXPECT_EQ(refused(along("25"), "<min_patch_size>[[8,1,1]]</min_patch_size>"),
            (Strings{"AMR/Regridder/min_patch_size: blocks of 8 cells do not divide the 25 cells of the grid along x; "
                     "no even number of at least 4 divides the number of cells: choose another <resolution>"}));
  EXPECT_EQ(refused(along("100"), "<min_patch_size>[[5,1,1]]</min_patch_size>"),
            (Strings{"AMR/Regridder/min_patch_size: found 5 along x, expected an even number of cells, at least 4"}));
  EXPECT_EQ(refused(along("100"), "<min_patch_size>[[2,1,1]]</min_patch_size>"),
            (Strings{"AMR/Regridder/min_patch_size: found 2 along x, expected an even number of cells, at least 4"}));
  EXPECT_EQ(refused(along("100"), "<min_patch_size>[[10,1,1],[20,1,1]]</min_patch_size>"),
            (Strings{"AMR/Regridder/min_patch_size: found [[10,1,1],[20,1,1]], expected the same for all levels: a "
                     "block is refined into blocks with the same number of cells"}));
  EXPECT_EQ(refused(along("1048576"), "<max_levels>16</max_levels>"),
            (Strings{"AMR/Regridder/max_levels: with 16 levels there would be 3.44e+10 cells in 2.15e+09 blocks along "
                     "x; at most 2.15e+09 cells and 1048576 blocks are possible"}));
}

TEST(Blocks, AreWhatTheSceneSays) {
  const Read found = read(square + halved, amr("<min_patch_size>[[4,16,1]]</min_patch_size>"
                                               "<cell_refinement_ratio>[[2,2,1],[2,2,1]]</cell_refinement_ratio>"));

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.refinement().blockCells[0], 4);
  EXPECT_EQ(found.refinement().blockCells[1], 16);
}

TEST(Blocks, ThatAreTooSmallForTheTasksGiveWayToTheNearestThatAreNot) {
  const auto blocksOf4 = [](const std::string& cells) {
    return read(level(box("0,0,0", "1,1,0", cells + ",60,1")),
                amr(adaptive + "<min_patch_size>[[4,6,1]]</min_patch_size>", criteria), {}, 6);
  };
  const Read found = blocksOf4("60");
  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.refinement().blockCells[0], 6);
  EXPECT_EQ(found.refinement().blockCells[1], 6);
  EXPECT_EQ(found.notes,
            (Strings{"AMR/Regridder/min_patch_size: blocks of 4 cells along x are too small for the tasks of this "
                     "scene, which need 6; blocks of 6 are used along this axis"}));
  EXPECT_EQ(blocksOf4("25").problems,
            (Strings{"AMR/Regridder/min_patch_size: blocks of 4 cells along x are too small for the tasks of this "
                     "scene, which need 6; no even number of at least 6 divides the number of cells: choose another "
                     "<resolution>"}));
}

TEST(Blocks, ThatDoNotDivideTheGridGiveWayToTheNearestThatDo) {
  const Read found = read(square, amr(adaptive + "<min_patch_size>[[10,8,1]]</min_patch_size>", criteria));
  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.refinement().blockCells[0], 8);
  EXPECT_EQ(found.notes, (Strings{"AMR/Regridder/min_patch_size: blocks of 10 cells do not divide the 64 cells of the "
                                  "grid along x; blocks of 8 are used along this axis"}));
}

}  // namespace tushar::scene
