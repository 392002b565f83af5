#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "components/components.hpp"
#include "core/scene/dry_run.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::scene {

namespace {

/// Writes a scene of `ups/` with text inserted behind the only occurrence of `before`; returns its path.
std::string changed(const std::string& scene, const std::string& before, const std::string& added) {
  std::ostringstream text;
  text << std::ifstream(scene).rdbuf();
  std::string all = text.str();
  const std::size_t at = all.find(before);
  EXPECT_EQ(all.rfind(before), at) << before;
  all.insert(at + before.size(), added);
  const std::string path = test::temporaryFolder() + std::filesystem::path(scene).filename().string();
  std::ofstream(path) << all;
  return path;
}

std::string withCriterion(const std::string& attributes) {
  return changed("ups/euler/sod.ups", "</Grid>",
                 "<AMR><Regridder type=\"Tiled\"><max_levels>3</max_levels></Regridder><Euler>"
                 "<Refinement_Criteria_Thresholds><Variable " +
                     attributes + "/></Refinement_Criteria_Thresholds></Euler></AMR>");
}
std::string withLevel(const std::string& scene) {
  return changed(scene, "</Level>",
                 "<Level><Box><lower>[.25,0,0]</lower><upper>[.75,1,1]</upper><resolution>[64,1,1]</resolution></Box>"
                 "</Level>");
}

/// Returns the problems of a scene, one per line.
std::string problemsOf(const std::string& path, const std::vector<std::string>& overrides = {}) {
  std::string text;
  try {
    readScene(path, overrides, catalogue());
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) text += problem.sentence + "\n";
  }
  return text;
}

}  // namespace

TEST(RefinedScenes, HaveTheirLevels) {
  const simulation::Problem problem = readScene(withLevel("ups/heat/sine.ups"), {}, catalogue());

  ASSERT_EQ(problem.grid->levels(), 2);
  EXPECT_EQ(problem.grid->blockCells()[0], 16);
  std::size_t cells = 0;
  for (const grid::Patch& patch : problem.grid->patches()) cells += patch.cells().size();
  EXPECT_EQ(cells, 32u + 64u);
  EXPECT_EQ(problem.notes.size(), 1u);  // on <patches>
}

TEST(RefinedScenes, BringTheirCriteria) {
  const simulation::Problem problem =
      readScene(withCriterion("name=\"c.pressure\" value=\".1\" matl=\"0\""), {}, catalogue());

  EXPECT_EQ(problem.grid->levels(), 3);
  EXPECT_TRUE(problem.regrid.adaptive);
  ASSERT_EQ(problem.regrid.criteria.size(), 1u);
  EXPECT_EQ(problem.regrid.criteria[0].variable, "c.pressure");
  EXPECT_EQ(problem.regrid.criteria[0].material, "");
  EXPECT_EQ(problem.regrid.where.line, problem.regrid.criteria[0].where.line);  // all of <AMR> stands in one line
  EXPECT_EQ(problem.notes.back().sentence, "matl does nothing: 'c.pressure' belongs to no material");
}

TEST(RefinedScenes, AreRefinedByTheCriteriaOfTheirComponentWhereTheyGiveNone) {
  const std::string adaptive = "<AMR><Regridder type=\"Tiled\"><adaptive>true</adaptive></Regridder></AMR>";
  const simulation::Problem gas = readScene(changed("ups/euler/sod.ups", "</Grid>", adaptive), {}, catalogue());
  ASSERT_EQ(gas.regrid.criteria.size(), 3u);
  EXPECT_EQ(gas.regrid.criteria[2].variable, "c.mach");
  std::ostringstream manual;
  describeAmr(manual, catalogue());
  const std::string told =
      fmt::format("jumps of {}, {} and {} above {:g}", gas.regrid.criteria[0].variable, gas.regrid.criteria[1].variable,
                  gas.regrid.criteria[2].variable, gas.regrid.criteria[0].refine);
  EXPECT_NE(manual.str().find(told), std::string::npos) << told;
  EXPECT_EQ(
      problemsOf(changed("ups/heat/sine.ups", "</Grid>", adaptive)),
      "<adaptive> true needs a <Variable> in <Refinement_Criteria_Thresholds>, which specifies where to refine\n");
}

TEST(RefinedScenes, NameVariablesThatAreThere) {
  const std::string misspelt = withCriterion("name=\"c.densty\" value=\".1\"");
  const std::string problems = problemsOf(misspelt);

  EXPECT_TRUE(problems.starts_with("name: found 'c.densty', expected 'c.density', ")) << problems;
  EXPECT_TRUE(problems.ends_with("(did you mean 'c.density'?)\n")) << problems;
  try {
    readScene(misspelt, {}, catalogue());
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().tagPath, "AMR/Euler/Refinement_Criteria_Thresholds/Variable");
  }
}

TEST(RefinedScenes, NameASectionOfTheirComponent) {
  const std::string problems = problemsOf(changed("ups/euler/sod.ups", "</Grid>", "<AMR><Euller/></AMR>"));
  EXPECT_TRUE(problems.starts_with("unknown tag <Euller> in <AMR> (did you mean 'Euler'?")) << problems;
}

TEST(RefinedScenes, AreRefusedToComponentsOfOneLevel) {
  simulation::ComponentKind kind = *catalogue().component("heat");
  kind.takesLevels = false;
  const simulation::Catalogue own({kind}, {});
  try {
    readScene(withLevel("ups/heat/sine.ups"), {}, own);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().sentence,
              "'heat' needs a grid of one level: one <Level> in <Grid>, and no <max_levels> above 1 in <AMR>");
  }
}

TEST(RefinedScenes, SaveNoFluxesThroughRims) {
  const std::string rim = "<save label=\"rim.c.temperature\"/>";
  const std::string problems = problemsOf(changed("ups/heat/sine.ups", "<save label=\"c.temperature\"/>", rim));
  EXPECT_TRUE(problems.starts_with("no task of this component computes 'rim.c.temperature'")) << problems;
  EXPECT_EQ(problems.find("and 'rim"), std::string::npos) << problems;
}

TEST(RefinedScenes, CanBePlannedForManyRanks) {
  const DryRun planned = dryRun(withLevel("ups/heat/sine.ups"), {}, catalogue(), {1, false, 3, Index3{{1, 1, 1}}});

  EXPECT_EQ(planned.patchesOfAll, 2 + 4);
  EXPECT_EQ(planned.patches, 2);
}

}  // namespace tushar::scene
