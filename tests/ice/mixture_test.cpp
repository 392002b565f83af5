#include <gtest/gtest.h>

#include "components/euler/mixture.hpp"
#include "components/ice/mixture/exchange_mass.hpp"
#include "components/ice/mixture/tasks.hpp"
#include "core/input/geometry/shapes.hpp"
#include "tests/euler/gas_box.hpp"
#include "tests/support/scenes.hpp"

namespace tushar::ice {

namespace {

using Overrides = std::vector<std::string>;
using test::changedScene;
using test::driftOf;
using test::problemOf;

const std::string tube = "ups/ice/two_gases.ups", waterTube = "ups/ice/water_air.ups",
                  drift = "ups/ice/water_drifts.ups", three = "ups/ice/three_gases.ups";

/// Returns the largest difference of a variable from a value after a scene without modules.
double greatestError(const std::string& scene, const std::string& variable, const std::string& value,
                     const Overrides& overrides) {
  const std::string module = "<DataAnalysis><Module name=\"exactSolution\">" + variable + "<value>" + value +
                             "</value></Module></DataAnalysis></Uintah_specification>";
  return test::runScene(changedScene(scene, "</Uintah_specification>", module), overrides).errors.at(0).norms.at("max");
}

double meanError(const std::string& scene, const Overrides& overrides) {
  return test::runScene(scene, overrides).errors.at(0).norms.at("L1");
}

const Overrides short3{"Time/maxTime=0.1", "Grid/Level/Box/resolution=[16,16,1]"};

}  // namespace

TEST(IceMixture, HasTheLawOfAGasThatIsAlone) {
  euler::MixedGas alone;
  alone.add(1, 4.4, 6e8);
  alone.add(0, 1.4, 0);
  const euler::StiffenedGas water{4.4, 6e8};
  const double p = 2e8, rho = 1040, energy = water.energyOf(rho, p);
  EXPECT_NEAR(alone.energyOf(rho, p) / energy, 1, 1e-15);
  EXPECT_NEAR(alone.pressure(rho, energy) / p, 1, 1e-14);
  EXPECT_NEAR(alone.soundSpeedSquared(rho, p) / water.soundSpeedSquared(rho, p), 1, 1e-15);
  EXPECT_NEAR(alone.heat(rho, p) / water.heat(rho, p), 1, 1e-15);
}

TEST(IceMixture, KeepsContactsOfWaterAndAirQuiet) {
  // The energy of water contains 6e8 Pa, so the pressure has a rounding error of 1e-7 Pa.
  const Overrides shortened{"Time/maxTime=0.001"};
  EXPECT_LT(greatestError(drift, "<label>c.pressure</label>", "1e5", shortened), 1e-5);
  EXPECT_LT(greatestError(drift, "<label>c.velocity</label><component>x</component>", "100", shortened), 1e-10);
  EXPECT_LT(greatestError(drift, "<label>c.temperature</label>", "250", shortened), 1e-9);
}

TEST(IceMixture, KeepsContactsOfThreeGasesQuiet) {
  const std::string module = "<label>c.density</label>";
  const auto with = [&](const std::string& variable, const std::string& value) {
    const std::string scene = changedScene(three, module, variable);
    Overrides overrides = short3;
    overrides.push_back("DataAnalysis/Module/value=" + value);
    return test::runScene(scene, overrides).errors.at(0).norms.at("max");
  };
  EXPECT_LT(with("<label>c.pressure</label>", "1"), 1e-12);
  EXPECT_LT(with("<label>c.velocity</label><component>y</component>", "1"), 1e-12);
}

TEST(IceMixture, CarriesSharesWithSecondOrder) {
  const double coarse = meanError(three, {"Time/maxTime=0.25", "Grid/Level/Box/resolution=[16,16,1]"});
  const double fine = meanError(three, {"Time/maxTime=0.25", "Grid/Level/Box/resolution=[32,32,1]"});
  EXPECT_LT(fine, 2.7e-3);
  EXPECT_GT(coarse / fine, 3);
}

TEST(IceMixture, ConvergesToTheTubeOfTwoGases) {
  const double coarse = meanError(tube, {"Grid/Level/Box/resolution=[100,1,1]"}), fine = meanError(tube, {});
  EXPECT_LT(fine, 2.7e-3);
  EXPECT_GT(coarse / fine, 1.7);
}

TEST(IceMixture, ConvergesToTheTubeOfWaterAndAir) {
  const report::ErrorNorms pressure = test::runScene(waterTube, {}).errors.at(2);
  EXPECT_LT(pressure.norms.at("L1"), 2.2e6);
}

TEST(IceMixture, KeepsMassAndEnergy) {
  for (const std::string& scene : {tube, waterTube})
    for (const char* name : {"mass", "energy"}) EXPECT_NEAR(driftOf(test::runScene(scene, {}), name), 0, 1e-14);
  for (const char* name : {"mass", "momentum", "energy"})
    EXPECT_NEAR(driftOf(test::runScene(three, short3), name), 0, 1e-14) << name;
}

TEST(IceMixture, OfOneGasTwiceIsThatGas) {
  // Both sides of the tube have gamma 1.4: the solution is that of Sod's tube.
  const Overrides sod{"Grid/Level/Box/resolution=[100,1,1]", "DataAnalysis/Module/right/gamma=1.4"};
  const std::string twice = changedScene(
      changedScene(tube, "<gamma>1.6666666666666667</gamma>\n        <spec", "<gamma>1.4</gamma>\n        <spec"),
      "<specific_heat>1.5", "<specific_heat>2.5");
  EXPECT_NEAR(meanError(twice, sod) / meanError("ups/ice/sod.ups", {}), 1, 0.05);
}

TEST(IceMixture, HasOneFingerprintOnAnyPatches) {
  const std::string whole = test::runScene(three, short3).fingerprint;
  for (const char* patches : {"[2,1,1]", "[4,4,1]"}) {
    Overrides overrides = short3;
    overrides.push_back("Grid/Level/Box/patches=" + std::string(patches));
    EXPECT_EQ(test::runScene(three, overrides).fingerprint, whole) << patches;
  }
}

TEST(IceMixture, RunsInThreeDimensions) {
  const Overrides box{"Grid/Level/Box/resolution=[8,8,8]", "Time/max_Timesteps=5"};
  EXPECT_NEAR(driftOf(test::runScene(three, box), "energy"), 0, 1e-14);
}

TEST(IceMixture, RefusesGasesThatDoNotFillTheGrid) {
  try {
    test::runScene(tube, {"MaterialProperties/ICE/material[1]/geom_object/box/max=[0.4,1,1]"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("together they must fill the grid"), std::string::npos) << error.what();
  }
}

TEST(IceMixture, RefusesASlowExchange) {
  EXPECT_EQ(problemOf(changedScene(tube, "<momentum>[1e15]", "<momentum>[100]")),
            "100 between gases is not available: gases share one velocity, so the value is expected to be 1e9 or more");
  EXPECT_EQ(problemOf(changedScene(tube, "<heat>[0]", "<heat>[0,0]")),
            "found 2 numbers, expected 1: one for each pair of 2 gases");
}

TEST(IceMixture, RefusesWhatItHasNot) {
  EXPECT_EQ(problemOf(changedScene(tube, "<specific_heat>1.5</specific_heat>",
                                   "<specific_heat>1.5</specific_heat><dynamicViscosityModels><Model "
                                   "name=\"Sutherland\"><a>1</a><b>1</b></Model></dynamicViscosityModels>")),
            "is not available with a second gas: give <dynamic_viscosity>, or keep one gas");
  EXPECT_EQ(problemOf(changedScene(tube, "<material name=\"helium\">", "<material name=\"air\">")),
            "the name 'air' is given twice");
}

TEST(IceMixture, RefusesSidesOfOneGas) {
  const auto with = [](const std::string& condition) {
    return changedScene(tube, R"(<Face side="x-"><BCType id="all" label="Symmetric" var="symmetry"/>)",
                        "<Face side=\"x-\">" + condition);
  };
  EXPECT_EQ(problemOf(with(R"(<BCType id="all" label="Density" var="Dirichlet"><value>1</value></BCType>)")),
            "Dirichlet is not available with several gases: the gas that flows in has the composition of the "
            "adjacent cells; give a Velocity or a Pressure, or Neumann");
  EXPECT_EQ(problemOf(with(R"(<BCType id="1" label="Velocity" var="Dirichlet"><value>[1,0,0]</value></BCType>)")),
            "found '1', expected all: several gases have one velocity and one pressure");
  EXPECT_EQ(problemOf(with(R"(<BCType id="1" label="Pressure" var="Dirichlet"><value>1</value></BCType>)")),
            "found '1', expected all: several gases have one velocity and one pressure");
  EXPECT_EQ(problemOf(with(R"(<BCType id="2" label="Pressure" var="Neumann"><value>0</value></BCType>)")),
            "there is no material 2: the gases have indices 0 to 1");
  EXPECT_EQ(problemOf(with(R"(<BCType id="0" label="Pressure" var="Dirichlet"><value>1</value></BCType>)")), "");
}

TEST(IceMixture, BeginsWithTheShareOfEachGasInCellsThatASurfaceCuts) {
  // Water with the density 4 up to x = .6, and air with the density 1 beyond, in four cells; .6 is in the third one.
  const auto gas = [](double from, double to, double density, int points) {
    auto slab = std::make_shared<input::Box>();
    slab->min = Vec3(from, -1, -1);
    slab->max = Vec3(to, 2, 2);
    euler::Settings settings;
    settings.gas.specificHeat = 2.5;
    settings.objects = {{.where = {},
                         .shape = slab,
                         .density = input::Expression(density),
                         .pressure = input::Expression(1),
                         .velocity = {},
                         .points = Index3{{points, 1, 1}}}};
    return settings;
  };
  const Grid grid(euler::closedBox(1, 4));
  for (const int points : {1, 2, 5}) {
    const Gases gases{gas(-1, 0.6, 4, points), gas(0.6, 2, 1, 1)};
    const auto start = MixtureStart<1>::in(grid.level(), gases, Index<1>{{2}});
    const double share = points == 1 ? 0 : points == 2 ? 0.5 : 0.4;  // of the points below .6, from .5 to .75
    EXPECT_DOUBLE_EQ(start.share[0], share) << points;
    EXPECT_DOUBLE_EQ(start.mass[0], 4 * share);
    EXPECT_DOUBLE_EQ(start.share[1] + share, 1);
    EXPECT_DOUBLE_EQ(start.sum[euler::kDensity], 4 * share + 1 - share);
    EXPECT_EQ(MixtureStart<1>::in(grid.level(), gases, Index<1>{{1}}).share[0], 1);
  }
}

TEST(IceMixture, RefusesFourGases) {
  const std::string more = R"(<material><EOS type="ideal_gas"/><gamma>1.4</gamma><specific_heat>1</specific_heat>
      <geom_object><sphere><origin>[0,0,0]</origin><radius>1</radius></sphere><density>1</density>
      <temperature>1</temperature></geom_object></material>)";
  const std::string end = "    </ICE>\n    <exchange";
  EXPECT_EQ(problemOf(changedScene(three, end, more + end)), "more than 3 gases are not available");
}

namespace {

/// A scene of several gases with finer cells where their volume fractions vary.
std::string refined(const std::string& scene, const std::string& ratio = "[[2,2,2]]") {
  return changedScene(scene, "</Uintah_specification>",
                      "<AMR><ICE><Refinement_Criteria_Thresholds><Variable name=\"vol_frac_CC\" type=\"gradient\" "
                      "value=\"0.5\" matl=\"all\"/></Refinement_Criteria_Thresholds></ICE><Regridder><max_levels>2"
                      "</max_levels><cell_refinement_ratio>" +
                          ratio + "</cell_refinement_ratio></Regridder></AMR></Uintah_specification>");
}

/// A test model of the scene: air becomes helium.
std::string withTransfer(const std::string& rate) {
  return changedScene(tube, "</Uintah_specification>",
                      "<Models><Model type=\"Test\"><Test><fromMaterial>air</fromMaterial><toMaterial>helium"
                      "</toMaterial><rate>" +
                          rate + "</rate></Test></Model></Models></Uintah_specification>");
}

}  // namespace

TEST(IceMixtureLevels, KeepMassMomentumAndEnergy) {
  for (const char* ratio : {"[[2,2,2]]", "[[4,4,4]]"}) {
    const report::Report report =
        test::runScene(refined(three, ratio), {"Time/maxTime=0.1", "Grid/Level/Box/resolution=[16,16,1]"});
    for (const char* name : {"mass", "momentum", "energy"}) EXPECT_NEAR(driftOf(report, name), 0, 1e-14) << name;
  }
}

TEST(IceMixtureLevels, KeepContactsQuiet) {
  const auto with = [](const std::string& variable, const std::string& value) {
    return test::runScene(
               changedScene(refined(three), "<label>c.density</label>", variable),
               {"Time/maxTime=0.1", "Grid/Level/Box/resolution=[16,16,1]", "DataAnalysis/Module/value=" + value})
        .errors.at(0)
        .norms.at("max");
  };
  EXPECT_LT(with("<label>c.pressure</label>", "1"), 1e-12);
  EXPECT_LT(with("<label>c.velocity</label><component>y</component>", "1"), 1e-12);
}

TEST(IceMixtureLevels, AreAsGoodAsFineCellsInATube) {
  const std::string scene = refined(tube);
  const double levels = meanError(scene, {"Grid/Level/Box/resolution=[100,1,1]"}),
               coarse = meanError(tube, {"Grid/Level/Box/resolution=[100,1,1]"});
  EXPECT_LT(levels, 0.9 * coarse);
}

TEST(IceMixtureLevels, HaveOneFingerprintOnAnyPatches) {
  const std::string scene = refined(three);
  const Overrides shortened{"Time/maxTime=0.05", "Grid/Level/Box/resolution=[16,16,1]"};
  const std::string whole = test::runScene(scene, shortened).fingerprint;
  simulation::Problem problem =
      scene::readScene(scene, shortened, catalogue(), grid::Workers{.layout = Index3{{1, 1, 1}}});
  problem.archive.saves.clear();
  simulation::RunOptions options;
  options.quiet = true;
  EXPECT_EQ(simulation::Simulation(std::move(problem), options, std::chrono::steady_clock::now()).run().fingerprint,
            whole);
}

TEST(IceMixture, BecomesAnotherGas) {
  // With a rate higher than a step allows, everything is converted in the first step.
  const report::Report report = test::runScene(withTransfer("1e9"), {});
  EXPECT_NEAR(driftOf(report, "mass"), 0, 1e-14);
  EXPECT_NEAR(driftOf(report, "energy"), 0, 1e-14);
  EXPECT_EQ(problemOf(withTransfer("-1")), "found '-1', expected a value of at least 0 1/s");
}

TEST(IceMixture, TransfersAPartOfAGas) {
  double massOf[] = {3, 1}, shareOf[] = {0.75, 0.25};
  const Box cell{{}, Index3::filled(1)};
  std::vector<euler::ChangedGas> held;
  for (int k = 0; k < 2; ++k) held.push_back({{&massOf[k], cell, cell}, {&shareOf[k], cell, cell}});
  const grid::Grid grid{grid::Domain{}};
  transferMass<1>(grid.patches().front(), {}, {0, 1, 2, 0.5}, 0.4, 0.1, held);
  EXPECT_EQ(massOf[0], 3);
  transferMass<1>(grid.patches().front(), {}, {0, 1, 2, 0.5}, 0.5, 0.1, held);
  EXPECT_NEAR(massOf[0], 2.4, 1e-15);
  EXPECT_NEAR(massOf[1], 1.6, 1e-15);
  EXPECT_NEAR(shareOf[0], 0.6, 1e-15);
  EXPECT_NEAR(shareOf[1], 0.4, 1e-15);
}

TEST(IceMixture, OfOneGasTwiceHasItsViscosity) {
  // The channel's gas as two materials, each in half of it.
  const std::string box = "<box label=\"all\"><min>[0,0,0]</min><max>[1,1,1]</max></box>";
  const std::string half = "<volumeFraction>0.5</volumeFraction>";
  const std::string material = R"(<material name="other"><EOS type="ideal_gas"/><gamma>1.4</gamma>
      <specific_heat>2.5</specific_heat><dynamic_viscosity>0.1</dynamic_viscosity>
      <thermal_conductivity>0.35</thermal_conductivity><geom_object><box label="other"><min>[0,0,0]</min>
      <max>[1,1,1]</max></box><density>1</density><temperature>1</temperature>)" +
                               half + "</geom_object></material>";
  const Overrides coarse{"Grid/Level/Box/resolution=[2,16,1]"};
  const std::string channel = "ups/ice/channel.ups";
  const double alone = test::runScene(channel, coarse).errors.at(0).norms.at("max");
  std::string both = changedScene(channel, box, box + half);
  both = changedScene(both, "    </ICE>\n  </Mat", material + "    </ICE>\n  </Mat");
  std::stringstream text;
  text << std::ifstream(both).rdbuf();
  std::string all = text.str();
  for (std::size_t at = all.find("BCType id=\"0\""); at != std::string::npos; at = all.find("BCType id=\"0\""))
    all.replace(at, 13, "BCType id=\"all\"");
  std::ofstream(both) << all;
  EXPECT_NEAR(test::runScene(both, coarse).errors.at(0).norms.at("max"), alone, 1e-9);
}

}  // namespace tushar::ice
