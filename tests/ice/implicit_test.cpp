#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace tushar::ice {

namespace {

using test::changedScene;
using test::driftOf;
using test::errorOf;
using test::problemOf;
using Overrides = std::vector<std::string>;

const std::string sod = "ups/ice/sod_implicit.ups", vortex = "ups/ice/vortex_slow.ups",
                  gresho = "ups/ice/gresho_slow.ups", bubble = "ups/ice/hot_bubble.ups";

Overrides cells(int x, int y) { return {fmt::format("Grid/Level/Box/resolution=[{},{},1]", x, y)}; }

const std::string control = "<knob_for_speedSound>0</knob_for_speedSound>";

/// A tube of gas of 1 kg/m³ and 100 K, R = 1 J/(kg K), with conditions at both ends; measures the pressure's error.
std::string tube(const std::string& lower, const std::string& upper, bool isImplicit = true) {
  std::string scene =
      changedScene("ups/ice/heat_wave.ups", "<label>c.temperature</label>", "<label>c.pressure</label>");
  if (isImplicit)
    scene = changedScene(scene, "<ICE><advection",
                         "<ICE><ImplicitSolver/><TimeStepControl>" + control + "</TimeStepControl><advection");
  scene = changedScene(scene, "<periodic>[1,0,0]</periodic>", "");
  scene = changedScene(scene, "<density>1/(1+0.001*sin(2*pi*x))", "<density>1");
  scene = changedScene(scene, "<temperature>100*(1+0.001*sin(2*pi*x))", "<temperature>100");
  scene = changedScene(scene, "<thermal_conductivity>0.035", "<thermal_conductivity>0");
  return changedScene(
      scene, "<BoundaryConditions>",
      "<BoundaryConditions><Face side=\"x-\">" + lower + "</Face><Face side=\"x+\">" + upper + "</Face>");
}

const std::string wall = R"(<BCType id="all" label="Symmetric" var="symmetry"/>)",
                  inflow = R"(<BCType id="0" label="Velocity" var="Dirichlet"><value>[0.1,0,0]</value></BCType>)"
                           R"(<BCType id="0" label="Temperature" var="Dirichlet"><value>100</value></BCType>)";

}  // namespace

TEST(ImplicitIce, KeepsThePressureOfABoxAtRestInStepsWithoutLimit) {
  // Ripples of 1e-4 Pa; the second step is some thousand seconds long, in which sound crosses a million cells.
  const report::Report report =
      test::runScene(tube(wall, wall), {"MaterialProperties/ICE/material/geom_object/density=1+1e-6*sin(pi*x)",
                                        "DataAnalysis/Module/value=100", "Time/maxTime=2000"});
  EXPECT_LT(report.steps, 20);
  EXPECT_LT(report.errors.at(0).norms.at("max"), 1e-4);
}

TEST(ImplicitIce, LetsGasOutThroughSidesWithoutPressure) {
  // The gas was pushed with rho c u = 1.18 Pa, and all gas that flows in flows out.
  for (const char* reversed : {"", "-"}) {
    const bool isReversed = *reversed != 0;
    const std::string in = isReversed ? std::string(inflow).replace(inflow.find("[0.1"), 4, "[-0.1") : inflow;
    for (const std::string open : {"", R"(<BCType id="0" label="Pressure" var="Neumann"><value>0</value></BCType>)"}) {
      const std::string scene = isReversed ? tube(open, in) : tube(in, open);
      const report::Report report =
          test::runScene(scene, {"DataAnalysis/Module/value=100+0.1*sqrt(140)", "Time/maxTime=20"});
      EXPECT_LT(report.errors.at(0).norms.at("max"), 0.1) << reversed << open;
      EXPECT_NEAR(driftOf(report, "mass"), 0, 0.02) << reversed << open;
    }
  }
}

TEST(ImplicitIce, KeepsAFlowThroughATubeThatIsOpenAtBothEnds) {
  const report::Report report =
      test::runScene(tube("", ""), {"MaterialProperties/ICE/material/geom_object/velocity=[1,0,0]",
                                    "DataAnalysis/Module/value=100", "Time/maxTime=5"});
  EXPECT_LT(report.errors.at(0).norms.at("max"), 1e-8);
  EXPECT_NEAR(driftOf(report, "mass"), 0, 1e-12);
}

TEST(ImplicitIce, HasTheWavesOfSodsTube) {
  const report::Report report = test::runScene(sod, {});
  EXPECT_LT(errorOf(report, "density"), 0.0105);
  EXPECT_LT(errorOf(test::runScene(sod, cells(400, 1)), "density"), 0.0035);
  for (const char* name : {"mass", "energy"}) EXPECT_NEAR(driftOf(report, name), 0, 1e-14) << name;
}

TEST(ImplicitIce, ConvergesInASlowVortex) {
  const report::Report coarse = test::runScene(vortex, cells(32, 32)), fine = test::runScene(vortex, {});
  EXPECT_GT(errorOf(coarse, "velocity") / errorOf(fine, "velocity"), 3.2);
  EXPECT_LT(errorOf(fine, "velocity"), 1.8e-3);
  EXPECT_LT(fine.steps, 60);
  for (const char* name : {"mass", "momentum", "energy"}) EXPECT_NEAR(driftOf(fine, name), 0, 1e-14) << name;
}

TEST(ImplicitIce, HasOneErrorAtAnyLowMachNumber) {
  const double slow = errorOf(test::runScene(gresho, cells(20, 20)), "velocity");
  const std::string faster = changedScene(changedScene(gresho, "714280.714285714", "7137.857142857"),
                                          "<pressure>714285.714285714", "<pressure>7142.857142857");
  EXPECT_NEAR(errorOf(test::runScene(faster, cells(20, 20)), "velocity"), slow, 1e-4 * slow);
}

TEST(ImplicitIce, CarriesAContactAtOnePressure) {
  // p = 100 Pa; the error of the pressure that corresponds to the formula of the temperature in the scene.
  std::string scene =
      changedScene("ups/ice/heat_wave.ups", "<ICE><advection",
                   "<ICE><ImplicitSolver/><TimeStepControl>" + control + "</TimeStepControl><advection");
  scene = changedScene(scene, "<label>c.temperature</label>", "<label>c.pressure</label>");
  const report::Report report =
      test::runScene(scene, {"MaterialProperties/ICE/material/thermal_conductivity=0", "DataAnalysis/Module/value=100",
                             "MaterialProperties/ICE/material/geom_object/velocity=[1,0,0]", "Time/maxTime=0.5"});
  EXPECT_LT(report.errors.at(0).norms.at("max"), 1e-8);
}

TEST(ImplicitIce, KeepsLayersAtRest) {
  const std::string still = changedScene(bubble, "(287*(300 + 30*exp(-((x-0.5)^2 + (y-0.4)^2)/0.02)))", "(287*300)");
  Overrides overrides = cells(4, 32);
  overrides.push_back("MaterialProperties/ICE/material/geom_object/temperature=300");
  const report::Report report = test::runScene(still, overrides);
  EXPECT_NEAR(driftOf(report, "momentum"), 0, 1e-6);
  EXPECT_NEAR(driftOf(report, "mass"), 0, 1e-14);
  EXPECT_LT(report.steps, 200);
}

TEST(ImplicitIce, HasOneFingerprintOnAnyPatches) {
  Overrides overrides = cells(16, 24);
  overrides.push_back("Time/maxTime=0.2");
  const std::string whole = test::runScene(bubble, overrides).fingerprint;
  for (const char* patches : {"[2,1,1]", "[1,4,1]", "[4,3,1]"}) {
    Overrides cut = overrides;
    cut.push_back("Grid/Level/Box/patches=" + std::string(patches));
    EXPECT_EQ(test::runScene(bubble, cut).fingerprint, whole) << patches;
  }
}

TEST(ImplicitIce, HasTheSameFlowAlongEachAxis) {
  std::string scene = changedScene(sod, "<min>[0.5,0,0]</min>", "<min>[0,0.5,0]</min>");
  scene = changedScene(scene, "<max>[0.5,1,1]</max>", "<max>[1,0.5,1]</max>");
  scene = changedScene(scene, "<left><density>", "<normal>[0,1,0]</normal><left><density>");
  EXPECT_EQ(errorOf(test::runScene(scene, cells(1, 100)), "density"), errorOf(test::runScene(sod, {}), "density"));
}

TEST(ImplicitIce, RepeatsAStepThatIsTooLong) {
  const std::string strong = changedScene(sod, "<temperature>0.8</temperature>", "<temperature>1e-5</temperature>");
  const report::Report report = test::runScene(strong, {"CFD/cfl=1", "Time/maxTime=0.1"});
  EXPECT_NEAR(driftOf(report, "energy"), 0, 1e-13);
}

TEST(ImplicitIce, IsPassedOverWhereTold) {
  EXPECT_EQ(test::runScene(sod, {"CFD/ICE/explicit=true"}).fingerprint,
            test::runScene("ups/ice/sod.ups", {"CFD/cfl=0.25"}).fingerprint);
}

TEST(ImplicitIce, LimitsStepsByAPartOfSound) {
  EXPECT_GT(test::runScene(sod, {"CFD/ICE/TimeStepControl/knob_for_speedSound=1"}).steps,
            test::runScene(sod, {}).steps);
  EXPECT_EQ(problemOf(changedScene(sod, control, "<knob_for_speedSound>2</knob_for_speedSound>")),
            "found '2', expected a value from 0 to 1");
}

TEST(ImplicitIce, TakesHalfOfSoundUnlessTold) {
  const std::string half = test::runScene(sod, {"CFD/ICE/TimeStepControl/knob_for_speedSound=0.5"}).fingerprint;
  EXPECT_EQ(test::runScene(changedScene(sod, control, ""), {}).fingerprint, half);
  EXPECT_NE(test::runScene(sod, {}).fingerprint, half);
}

TEST(ImplicitIce, TakesTheWordsOfUintahsScenes) {
  const std::string words =
      "<ImplicitSolver><max_outer_iterations>20</max_outer_iterations><outer_iteration_tolerance>1e-8"
      "</outer_iteration_tolerance><iters_before_timestep_restart>5</iters_before_timestep_restart>"
      "<Parameters variable=\"implicitPressure\"><tolerance>1.e-22</tolerance><solver>cg</solver>"
      "<preconditioner>pfmg</preconditioner><maxiterations>7500</maxiterations><npre>1</npre><npost>1</npost>"
      "<skip>0</skip><jump>0</jump></Parameters></ImplicitSolver>";
  const std::string scene =
      changedScene("ups/ice/sod.ups", "<ICE><advection",
                   "<ICE>" + words + "<TimeStepControl>" + control + "</TimeStepControl><advection");
  EXPECT_NEAR(errorOf(test::runScene(scene, {"CFD/cfl=0.25"}), "density"), errorOf(test::runScene(sod, {}), "density"),
              1e-8);
  EXPECT_EQ(problemOf(changedScene(scene, "pfmg", "pfng")).substr(0, 41), "found 'pfng', expected 'none', 'jacobi', ");
}

TEST(ImplicitIce, RefusesSeveralLevels) {
  EXPECT_EQ(problemOf(changedScene(sod, "    </Level>\n",
                                   "    </Level>\n    <Level><Box label=\"fine\"><lower>[0.25,0,0]</lower>"
                                   "<upper>[0.5,1,1]</upper><resolution>[50,1,1]</resolution></Box></Level>\n")),
            "'ice' needs a grid of one level: an <ImplicitSolver> solves for the pressure on one level; "
            "CFD/ICE/explicit=true switches it off");
}

}  // namespace tushar::ice
