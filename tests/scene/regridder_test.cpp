#include "tests/scene/read_levels.hpp"

namespace tushar::scene {

TEST(Regridder, SaysHowManyLevelsThereMayBe) {
  EXPECT_EQ(read(square, amr(adaptive, criteria)).refinement().levels, 2);
  EXPECT_EQ(read(square, amr(adaptive + "<max_levels>4</max_levels>", criteria)).refinement().levels, 4);
  EXPECT_EQ(read(square + halved, amr(adaptive, criteria)).refinement().levels, 2);
  EXPECT_EQ(read(square, amr("<max_levels>1</max_levels>")).refinement().levels, 1);

  const Read still = read(square, amr("<max_levels>3</max_levels>"));
  EXPECT_EQ(still.refinement().levels, 1);
  EXPECT_EQ(still.notes, (Strings{"AMR/Regridder/max_levels: does nothing: the grid is not <adaptive>, so its Levels "
                                  "alone determine what is refined"}));

  EXPECT_EQ(read(square + halved, amr("<max_levels>1</max_levels>")).problems,
            (Strings{"AMR/Regridder/max_levels: found 1, but the Levels of <Grid> define 2 levels"}));
  const Read single = read(square, amr(adaptive + "<max_levels>1</max_levels>", criteria));
  EXPECT_EQ(single.problems, Strings{});
  EXPECT_EQ(single.refinement().levels, 1);
  EXPECT_EQ(single.notes, (Strings{"AMR/Regridder/max_levels: with one level, <adaptive> does nothing"}));
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
  EXPECT_EQ(levels("2", "[[4,4,1]]"), 3);
  EXPECT_EQ(levels("3", "[[4,4,1]]"), 5);
  EXPECT_EQ(levels("4", "[[4,4,1],[2,2,1]]"), 5);
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
            (Strings{"AMR/Regridder/max_levels: found 12, which corresponds to 23 levels of ratio 2 because of "
                     "<cell_refinement_ratio>; at most 16 are possible"}));
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
           "<AMR type=\"Dynamic\"><useLockStep>true</useLockStep><Regridder type=\"BNR\">"
           "<max_timestep_interval>50</max_timestep_interval><min_boundary_cells>[1,1,0]</min_boundary_cells>"
           "</Regridder><ICE><orderOfInterpolation>1</orderOfInterpolation><ClampSpecificVolume>true</"
           "ClampSpecificVolume></ICE></AMR>");

  EXPECT_EQ(found.problems, Strings{});
  EXPECT_EQ(
      found.notes,
      (Strings{
          "AMR/Regridder/max_timestep_interval: does nothing: <min_timestep_interval> alone determines when to regrid",
          "AMR/Regridder/min_boundary_cells: does nothing: <cell_stability_dilation> alone widens the refined region, "
          "in addition to the distance that signals travel",
          "AMR/ICE/orderOfInterpolation: does nothing: interpolation between levels is of second order",
          "AMR: attribute 'type' does nothing: <Regridder> determines whether a grid is adaptive"}));
  EXPECT_FALSE(found.amr.smallerSteps);
}

TEST(Regridder, ReadsWhetherFinerLevelsTakeSmallerSteps) {
  const Read found = read(square, "<AMR><useLockStep>false</useLockStep></AMR>");
  EXPECT_EQ(found.problems, Strings{});
  EXPECT_TRUE(found.amr.smallerSteps);
  EXPECT_FALSE(read(square, "<AMR/>").amr.smallerSteps);
}

TEST(Regridder, SaysWhatIsMisspelt) {
  EXPECT_EQ(read(square, amr("<max_level>2</max_level>")).problems.at(0).substr(0, 90),
            "AMR/Regridder/max_level: unknown tag <max_level> in <Regridder> (did you mean 'max_levels'");
  EXPECT_EQ(read(square, "<AMR><Regridder type=\"SingleLevel\"/></AMR>").problems,
            (Strings{"AMR/Regridder: attribute 'type': found 'SingleLevel', expected 'Tiled' or 'BNR': <patches> in "
                     "the Box of a level, or --layout, determines the patches of a single level"}));
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
  EXPECT_EQ(
      refused("value=\"1\" type=\"second_derivative\""),
      Strings{path +
              "'value': found '1', expected a value less than 1, since the indicator second_derivative is at most 1"});
  EXPECT_EQ(refused("value=\"1\" coarsen=\"-1\""),
            Strings{path + "'coarsen': found '-1', expected a value of at least 0"});
  EXPECT_EQ(refused("value=\"1\" coarsen=\"2\""),
            Strings{path + "'coarsen': found '2', expected at most the attribute 'value', 1"});
  EXPECT_EQ(refused("value=\"1\" coarsen=\".5\" type=\"below\""),
            Strings{path + "'coarsen': found '0.5', expected at least the attribute 'value', 1"});
  EXPECT_EQ(
      refused("value=\"1\" type=\"gradiant\""),
      Strings{path + "'type': found 'gradiant', expected 'jump', 'second_derivative', 'gradient', 'above' or 'below' "
                     "(did you mean 'gradient'?)"});
}

TEST(Criteria, NeedAThresholdIfTheyAreOfAVariable) {
  const std::string path = "AMR/ICE/Refinement_Criteria_Thresholds/Variable: ";

  EXPECT_EQ(
      read(square, variable("name=\"c.p\"")).problems,
      Strings{path + "missing attribute 'value' of <Variable> (cells are refined where the indicator is above this)"});

  const Read particles = read(square, variable("name=\"particles\""));
  EXPECT_EQ(particles.problems, Strings{});
  EXPECT_EQ(particles.notes, Strings{});
  EXPECT_TRUE(particles.amr.regrid.adaptive);
  const std::string why = " does nothing: all cells with particles are on the finest level";
  EXPECT_EQ(read(square, variable("name=\"particles\" value=\"1\" matl=\"0\"")).notes,
            (Strings{path + "value" + why, path + "matl" + why}));
}

}  // namespace tushar::scene
