#include "core/scene/scene.hpp"
#include "tests/input/support.hpp"

namespace tushar::scene {

namespace {

using simulation::Criterion;
using Strings = std::vector<std::string>;

/// What the sections Grid and AMR say.
struct Read {
  grid::Domain domain;
  AmrSettings amr;
  Strings problems, notes;

  const grid::Refinement& refinement() const { return domain.refinement; }
};

Strings sentencesOf(const std::vector<InputProblem>& problems) {
  Strings sentences;
  for (const InputProblem& problem : problems) sentences.push_back(problem.tagPath + ": " + problem.sentence);
  return sentences;
}

Read read(const std::string& grid, const std::string& amr = "", const grid::Workers& workers = {}) {
  input::Diagnostics diagnostics;
  const input::Document document =
      input::Document::parse(input::scene("<Grid>" + grid + "</Grid>" + amr), "s.ups", diagnostics);
  Read read;
  if (const auto section = document.root().child("AMR")) read.amr = readAmr(*section, nullptr, diagnostics);
  read.domain = readGrid(*document.root().child("Grid"), {}, workers, read.amr, diagnostics);
  read.problems = sentencesOf(diagnostics.sorted());
  read.notes = sentencesOf(diagnostics.notes());
  return read;
}

std::string box(const std::string& lower, const std::string& upper, const std::string& cells,
                const std::string& more = "") {
  return "<Box><lower>[" + lower + "]</lower><upper>[" + upper + "]</upper><resolution>[" + cells + "]</resolution>" +
         more + "</Box>";
}
std::string level(const std::string& boxes) { return "<Level>" + boxes + "</Level>"; }

/// A square of 32² cells, without extent along z.
const std::string square = level(box("0,0,0", "2,1,0", "64,32,1"));
const std::string halved = level(box(".5,.25,0", "1,.5,0", "32,16,1"));

std::string amr(const std::string& regridder, const std::string& more = "") {
  return "<AMR><Regridder type=\"Tiled\">" + regridder + "</Regridder>" + more + "</AMR>";
}
const std::string adaptive = "<adaptive>true</adaptive>";
const std::string criteria =
    "<Euler><Refinement_Criteria_Thresholds><Variable name=\"c.density\" value=\".02\"/>"
    "</Refinement_Criteria_Thresholds></Euler>";
std::string variable(const std::string& attributes) {
  return "<AMR><ICE><Refinement_Criteria_Thresholds><Variable " + attributes +
         "/></Refinement_Criteria_Thresholds></ICE></AMR>";
}

}  // namespace

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

  EXPECT_EQ(
      refused(level(box(".5,.25,0", "1,.5,0", "48,24,1"))),
      (Strings{"Grid/Level/Box: its cells are 3 times as fine along x as those of the first Level, expected 2, 4, "
               "8 or another power of two"}));
  EXPECT_EQ(
      refused(level(box(".5,.25,0", "1,.5,0", "32,32,1"))),
      (Strings{"Grid/Level/Box: its cells are 2 times as fine along x, but 4 times along y; refine all axes alike, "
               "and give one more Level where one needs more"}));
  EXPECT_EQ(refused(level(box(".5,.25,0", "1,.5,0", "16,8,1"))),
            (Strings{"Grid/Level: this Level is not finer than the one before, at s.ups:1:30; Levels go from coarse to "
                     "fine"}));
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
            (Strings{"Grid/Level/Box: its cells are 4 times as fine as those of the first Level, but 2 times in a Box "
                     "above; give it a Level of its own"}));
  EXPECT_EQ(refused("<Level>" + box(".5,.25,0", "1,.5,0", "32,16,1") + "<periodic>[1,0,0]</periodic></Level>"),
            (Strings{"Grid/Level/periodic: found [1,0,0], but the first Level has [0,0,0]; all Levels are periodic "
                     "along the same axes"}));
  EXPECT_EQ(refused(level(box("0,0,0", "2,1,0", "4194304,2097152,1"))),
            (Strings{"Grid/Level: its cells are 65536 times as fine as those of the first Level; the most is 32768"}));
}

TEST(Levels, TheFirstHasOneBox) {
  const Read found = read(level(box("0,0,0", "1,1,0", "16,16,1") + box("0,0,0", "1,1,0", "16,16,1")));

  EXPECT_EQ(found.problems,
            (Strings{"Grid/Level/Box: the first Level has one Box; this is a second one (the first is at "
                     "s.ups:1:37)"}));
}

TEST(Levels, RefinedGridsHaveNoPatchesOfTheScene) {
  const Read found = read(level(box("0,0,0", "2,1,0", "64,32,1", "<patches>[2,2,1]</patches>")) +
                          level(box(".5,.25,0", "1,.5,0", "32,16,1", "<autoPatch>4</autoPatch>")));

  EXPECT_EQ(found.problems, Strings{});
  const std::string note =
      ": does nothing: patches of a refined grid are boxes of blocks; -layout sets how many blocks a patch has at the "
      "most";
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

  EXPECT_EQ(
      refused(along("22"), ""),
      (Strings{"Grid/Level/Box: its 22 cells along x cannot be cut into blocks of an even number of cells from 4 to "
               "18; choose another <resolution>, or give <min_patch_size> 22"}));
  EXPECT_EQ(
      refused(along("25"), ""),
      (Strings{"Grid/Level/Box: its 25 cells along x cannot be cut into blocks of an even number of cells from 4 to "
               "18; choose another <resolution>"}));
  EXPECT_EQ(
      refused(along("25"), "<min_patch_size>[[8,1,1]]</min_patch_size>"),
      (Strings{"AMR/Regridder/min_patch_size: blocks of 8 cells do not divide the 25 cells of the grid along x; no "
               "even number of at least 4 does: choose another <resolution>"}));
  EXPECT_EQ(refused(along("100"), "<min_patch_size>[[5,1,1]]</min_patch_size>"),
            (Strings{"AMR/Regridder/min_patch_size: found 5 along x, expected an even number of cells, at least 4"}));
  EXPECT_EQ(refused(along("100"), "<min_patch_size>[[2,1,1]]</min_patch_size>"),
            (Strings{"AMR/Regridder/min_patch_size: found 2 along x, expected an even number of cells, at least 4"}));
  EXPECT_EQ(refused(along("100"), "<min_patch_size>[[10,1,1],[20,1,1]]</min_patch_size>"),
            (Strings{"AMR/Regridder/min_patch_size: found [[10,1,1],[20,1,1]], expected the same for all levels: a "
                     "block is refined into blocks with as many cells as it has"}));
  EXPECT_EQ(refused(along("1048576"), "<max_levels>16</max_levels>"),
            (Strings{"AMR/Regridder/max_levels: 16 levels make 3.44e+10 cells in 2.15e+09 blocks along x; the most is "
                     "2.15e+09 cells, and 1048576 blocks"}));
}

TEST(Blocks, AreWhatTheSceneSays) {
  const Read found = read(square + halved, amr("<min_patch_size>[[4,16,1]]</min_patch_size>"
                                               "<cell_refinement_ratio>[[2,2,1],[2,2,1]]</cell_refinement_ratio>"));

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.refinement().blockCells[0], 4);
  EXPECT_EQ(found.refinement().blockCells[1], 16);
}

TEST(Blocks, ThatDoNotDivideTheGridGiveWayToTheNearestThatDo) {
  const Read found = read(square, amr(adaptive + "<min_patch_size>[[10,8,1]]</min_patch_size>", criteria));
  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(found.refinement().blockCells[0], 8);
  EXPECT_EQ(found.notes, (Strings{"AMR/Regridder/min_patch_size: blocks of 10 cells do not divide the 64 cells of the "
                                  "grid along x: here blocks have 8 along it"}));
}

TEST(Regridder, SaysHowManyLevelsThereMayBe) {
  EXPECT_EQ(read(square, amr(adaptive, criteria)).refinement().levels, 2);
  EXPECT_EQ(read(square, amr(adaptive + "<max_levels>4</max_levels>", criteria)).refinement().levels, 4);
  EXPECT_EQ(read(square + halved, amr(adaptive, criteria)).refinement().levels, 2);
  EXPECT_EQ(read(square, amr("<max_levels>1</max_levels>")).refinement().levels, 1);

  const Read still = read(square, amr("<max_levels>3</max_levels>"));
  EXPECT_EQ(still.refinement().levels, 1);
  EXPECT_EQ(still.notes,
            (Strings{"AMR/Regridder/max_levels: does nothing: where the grid is not <adaptive>, its Levels "
                     "say what is refined"}));

  EXPECT_EQ(read(square + halved, amr("<max_levels>1</max_levels>")).problems,
            (Strings{"AMR/Regridder/max_levels: found 1, but the Levels of <Grid> make 2"}));
  EXPECT_EQ(read(square, amr(adaptive + "<max_levels>1</max_levels>", criteria)).problems,
            (Strings{"AMR/Regridder/max_levels: found 1, expected at least 2, since the grid is <adaptive>"}));
  EXPECT_EQ(read(square, amr("<max_levels>17</max_levels>")).problems,
            (Strings{"AMR/Regridder/max_levels: found '17', expected a value from 1 to 16"}));
}

TEST(Regridder, TakesARatioOfFourAsTwoLevels) {
  const auto levels = [](const std::string& most, const std::string& ratios) {
    const Read found = read(square, amr(adaptive + "<max_levels>" + most + "</max_levels><cell_refinement_ratio>" +
                                            ratios + "</cell_refinement_ratio>",
                                        criteria));
    EXPECT_EQ(found.problems, Strings{});
    return found.refinement().levels;
  };
  EXPECT_EQ(levels("3", "[[2,2,1]]"), 3);
  EXPECT_EQ(levels("2", "[[4,4,1]]"), 3);
  EXPECT_EQ(levels("3", "[[4,4,1]]"), 5);
  EXPECT_EQ(levels("4", "[[4,4,1],[2,2,1]]"), 5);
  EXPECT_EQ(read(square, amr(adaptive + "<cell_refinement_ratio>[[4,4,1]]</cell_refinement_ratio>", criteria))
                .refinement()
                .levels,
            3);
}

TEST(Regridder, RefusesOtherRatios) {
  const auto refused = [](const std::string& ratio, const std::string& further = "") {
    return read(square, amr("<cell_refinement_ratio>" + ratio + "</cell_refinement_ratio>" + further)).problems;
  };
  const std::string power = "expected 2, 4, 8 or another power of two, the same along each axis that the grid uses";
  EXPECT_EQ(refused("[2,2,4]"), Strings{});
  EXPECT_EQ(refused("[[3,3,1]]"), Strings{"AMR/Regridder/cell_refinement_ratio: found 3 along x, " + power});
  EXPECT_EQ(refused("[[4,2,1]]"), Strings{"AMR/Regridder/cell_refinement_ratio: found 2 along y, " + power});
  EXPECT_EQ(refused("[[1,1,1]]"), Strings{"AMR/Regridder/cell_refinement_ratio: found 1 along x, " + power});
  EXPECT_EQ(read(square, amr(adaptive + "<max_levels>12</max_levels><cell_refinement_ratio>[[4,4,1]]"
                                        "</cell_refinement_ratio>",
                             criteria))
                .problems,
            (Strings{"AMR/Regridder/max_levels: found 12, which by <cell_refinement_ratio> are 23 levels of ratio 2; "
                     "the most is 16"}));
  EXPECT_EQ(read(square, amr("<simple_refinement_ratio>4</simple_refinement_ratio>")).problems,
            (Strings{"AMR/Regridder/simple_refinement_ratio: found '4', expected 2: give one more level instead"}));
}

TEST(Regridder, IsReadWithItsDefaults) {
  const simulation::RegridSettings plain = read(square, amr(adaptive, criteria)).amr.regrid;
  EXPECT_TRUE(plain.adaptive);
  EXPECT_FALSE(plain.once);
  EXPECT_EQ(plain.interval, 8);
  EXPECT_EQ(plain.dilation, 1);
  EXPECT_TRUE(plain.refluxes);

  const simulation::RegridSettings given =
      read(square,
           "<AMR><Regridder><regrid_once>true</regrid_once><min_timestep_interval>3</min_timestep_interval>"
           "<cell_stability_dilation>[2,3,0]</cell_stability_dilation></Regridder>"
           "<Heat><do_Refluxing>false</do_Refluxing></Heat></AMR>")
          .amr.regrid;
  EXPECT_FALSE(given.adaptive);
  EXPECT_TRUE(given.once);
  EXPECT_EQ(given.interval, 3);
  EXPECT_EQ(given.dilation, 3);
  EXPECT_FALSE(given.refluxes);
}

TEST(Regridder, IsAdaptiveWhereThereAreThresholdsUnlessTheSceneSaysOtherwise) {
  EXPECT_TRUE(read(square, "<AMR>" + criteria + "</AMR>").amr.regrid.adaptive);
  EXPECT_EQ(read(square, "<AMR>" + criteria + "</AMR>").refinement().levels, 2);

  const Read still = read(square, amr("<adaptive>false</adaptive>", criteria));
  EXPECT_FALSE(still.amr.regrid.adaptive);
  EXPECT_EQ(still.notes,
            (Strings{"AMR/Euler/Refinement_Criteria_Thresholds/Variable: does nothing: the grid is not <adaptive>"}));
}

TEST(Regridder, NotesWhatOfUintahsDoesNothing) {
  const Read found =
      read(square,
           "<AMR type=\"Dynamic\"><useLockStep>false</useLockStep><Regridder type=\"BNR\">"
           "<max_timestep_interval>50</max_timestep_interval><min_boundary_cells>[1,1,0]</min_boundary_cells>"
           "</Regridder><ICE><orderOfInterpolation>1</orderOfInterpolation></ICE></AMR>");

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(
      found.notes,
      (Strings{
          "AMR/Regridder/max_timestep_interval: does nothing: every regrid is due by <min_timestep_interval>",
          "AMR/Regridder/min_boundary_cells: does nothing: <cell_stability_dilation> alone widens the refined region, "
          "besides the distance that signals travel",
          "AMR/ICE/orderOfInterpolation: does nothing: values between levels are of second order",
          "AMR/useLockStep: all levels take the same time step: smaller steps on finer levels are not available yet"}));
}

TEST(Regridder, SaysWhatIsMisspelt) {
  EXPECT_EQ(read(square, amr("<max_level>2</max_level>")).problems.at(0).substr(0, 90),
            "AMR/Regridder/max_level: unknown tag <max_level> in <Regridder> (did you mean 'max_levels'");
  EXPECT_EQ(read(square, "<AMR><Regridder type=\"SingleLevel\"/></AMR>").problems,
            (Strings{"AMR/Regridder: attribute 'type': found 'SingleLevel', expected 'Tiled' or 'BNR': patches of one "
                     "level are chosen by <patches> of its Box, or -layout"}));
  EXPECT_EQ(read(square, "<AMR><Euler/><Euler/></AMR>").problems.size(), 1u);
}

TEST(Criteria, HaveTwoThresholds) {
  const auto found = [](const std::string& attributes) {
    return read(square, variable(attributes)).amr.regrid.criteria.at(0);
  };

  const Criterion jump = found("name=\"c.density\" value=\".02\"");
  EXPECT_EQ(jump.variable, "c.density");
  EXPECT_EQ(jump.material, "");
  EXPECT_EQ(jump.indicator, Criterion::Indicator::jump);
  EXPECT_EQ(jump.refine, .02);
  EXPECT_EQ(jump.coarsen, .01);
  EXPECT_EQ(found("name=\"c.p\" value=\".02\" coarsen=\".015\" matl=\"0\"").coarsen, .015);
  EXPECT_EQ(found("name=\"c.p\" value=\".02\" matl=\"0\"").material, "0");
  EXPECT_EQ(found("name=\"c.p\" value=\".02\" matl=\"all\"").material, "");
  EXPECT_EQ(found("name=\"c.p\" value=\"4\" type=\"gradient\"").indicator, Criterion::Indicator::gradient);
  EXPECT_EQ(found("name=\"c.p\" value=\"4\" type=\"above\"").coarsen, 2);
  EXPECT_EQ(found("name=\"c.p\" value=\"-4\" type=\"above\"").coarsen, -6);
  EXPECT_EQ(found("name=\"c.p\" value=\"4\" type=\"below\"").coarsen, 6);
  EXPECT_EQ(found("name=\"c.p\" value=\".5\" type=\"second_derivative\"").indicator,
            Criterion::Indicator::secondDerivative);
}

TEST(Criteria, ThatCannotBeGetASentence) {
  const auto refused = [](const std::string& attributes) {
    return read(square, variable("name=\"c.p\" " + attributes)).problems;
  };
  const std::string path = "AMR/ICE/Refinement_Criteria_Thresholds/Variable: attribute ";

  EXPECT_EQ(refused("value=\"0\""), Strings{path + "'value': found '0', expected a value greater than 0"});
  EXPECT_EQ(refused("value=\"1\" type=\"second_derivative\""),
            Strings{path + "'value': found '1', expected a value less than 1, which no second_derivative exceeds"});
  EXPECT_EQ(refused("value=\"1\" coarsen=\"-1\""),
            Strings{path + "'coarsen': found '-1', expected a value of at least 0"});
  EXPECT_EQ(refused("value=\"1\" coarsen=\"2\""),
            Strings{path + "'coarsen': found '2', expected a value not above that of value, 1"});
  EXPECT_EQ(refused("value=\"1\" coarsen=\".5\" type=\"below\""),
            Strings{path + "'coarsen': found '0.5', expected a value not below that of value, 1"});
  EXPECT_EQ(
      refused("value=\"1\" type=\"gradiant\""),
      Strings{path + "'type': found 'gradiant', expected 'jump', 'second_derivative', 'gradient', 'above' or 'below' "
                     "(did you mean 'gradient'?)"});
}

TEST(Criteria, NeedAThresholdIfTheyAreOfAVariable) {
  const std::string path = "AMR/ICE/Refinement_Criteria_Thresholds/Variable: ";

  EXPECT_EQ(read(square, variable("name=\"c.p\"")).problems,
            Strings{path + "missing attribute 'value' of <Variable> (finer cells where the indicator is above this)"});

  const Read particles = read(square, variable("name=\"particles\""));
  EXPECT_EQ(particles.problems, Strings{});
  EXPECT_EQ(particles.notes, Strings{});
  EXPECT_TRUE(particles.amr.regrid.adaptive);
  const std::string why = " does nothing: all cells with particles are on the finest level";
  EXPECT_EQ(read(square, variable("name=\"particles\" value=\"1\" matl=\"0\"")).notes,
            (Strings{path + "value" + why, path + "matl" + why}));
}

}  // namespace tushar::scene
