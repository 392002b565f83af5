#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

// Implicit steps of several gases.

namespace tushar::ice {

namespace {

using test::changedScene;
using test::driftOf;
using test::errorOf;
using test::problemOf;
using Overrides = std::vector<std::string>;

const std::string slow = "ups/ice/slow_gases.ups", twoGases = "ups/ice/two_gases.ups";

Overrides cells(int x, int y) { return {fmt::format("Grid/Level/Box/resolution=[{},{},1]", x, y)}; }

/// Returns an explicit scene with implicit steps, which sound does not limit, in place of its own.
std::string implicitly(const std::string& scene) {
  const std::string knob = "<knob_for_speedSound>0</knob_for_speedSound>", order = "<advection type=\"SecondOrder\"/>";
  if (scene != twoGases) return changedScene(scene, "<TimeStepControl>", "<ImplicitSolver/><TimeStepControl>" + knob);
  return changedScene(scene, order, order + "<ImplicitSolver/><TimeStepControl>" + knob + "</TimeStepControl>");
}

/// Returns the largest difference of a variable from a value at the end of a scene.
double greatestError(const std::string& scene, const std::string& variable, const std::string& value,
                     const Overrides& overrides) {
  const std::string module = "<DataAnalysis><Module name=\"exactSolution\"><label>" + variable + "</label><value>" +
                             value + "</value></Module></DataAnalysis></Uintah_specification>";
  return test::runScene(changedScene(scene, "</Uintah_specification>", module), overrides).errors.at(0).norms.at("max");
}

}  // namespace

TEST(ImplicitMixture, OfOneGasTwiceIsThatGas) {
  // The shares of both vary from .2 to .8, and the flow is that of ups/ice/vortex_slow.ups.
  const report::Report coarse = test::runScene(slow, cells(32, 32)), fine = test::runScene(slow, {});
  const report::Report alone = test::runScene("ups/ice/vortex_slow.ups", {});
  EXPECT_NEAR(errorOf(fine, "velocity") / errorOf(alone, "velocity"), 1, 0.1);
  EXPECT_GT(errorOf(coarse, "velocity") / errorOf(fine, "velocity"), 3.2);
  for (const char* name : {"mass", "momentum", "energy"}) EXPECT_NEAR(driftOf(fine, name), 0, 1e-14) << name;
}

TEST(ImplicitMixture, CarriesSharesWithSecondOrder) {
  // At a pressure of 1e6 Pa sound is a thousand times as fast as the flow.
  std::string scene = implicitly("ups/ice/three_gases.ups");
  scene = changedScene(scene, "<temperature>1</temperature>", "<temperature>1e6</temperature>");
  scene = changedScene(scene, "<temperature>0.83333333333333333<", "<temperature>833333.33333333333<");
  scene = changedScene(scene, "<temperature>2<", "<temperature>2e6<");
  const auto with = [&](int n) {
    Overrides overrides = cells(n, n);
    overrides.push_back("Time/maxTime=0.25");
    return test::runScene(scene, overrides);
  };
  const report::Report coarse = with(16), fine = with(32);
  EXPECT_LT(fine.errors.at(0).norms.at("L1"), 4e-3);
  EXPECT_GT(coarse.errors.at(0).norms.at("L1") / fine.errors.at(0).norms.at("L1"), 3);
  EXPECT_LT(fine.steps, 70);
  for (const char* name : {"mass", "momentum", "energy"}) EXPECT_NEAR(driftOf(fine, name), 0, 1e-14) << name;
}

TEST(ImplicitMixture, KeepsContactsQuiet) {
  // Water of 6e8 Pa in air of 1e5 Pa, at 100 m/s.
  const Overrides shortened{"Time/maxTime=0.002"};
  EXPECT_LT(greatestError(implicitly("ups/ice/water_drifts.ups"), "c.pressure", "1e5", shortened), 1);
  EXPECT_LT(greatestError(implicitly("ups/ice/water_drifts.ups"), "c.temperature", "250", shortened), 2e-3);
}

TEST(ImplicitMixture, HasTheWavesOfATubeOfTwoGases) {
  const std::string tube = implicitly(twoGases);
  const report::Report coarse = test::runScene(tube, {"Grid/Level/Box/resolution=[100,1,1]", "CFD/cfl=0.25"});
  const report::Report fine = test::runScene(tube, {"Grid/Level/Box/resolution=[400,1,1]", "CFD/cfl=0.25"});
  EXPECT_LT(errorOf(coarse, "density"), 0.0112);
  EXPECT_LT(errorOf(fine, "density"), 0.0037);
  for (const char* name : {"mass", "energy"}) EXPECT_NEAR(driftOf(fine, name), 0, 1e-14) << name;
}

TEST(ImplicitMixture, TakesInTheGasesOfTheAdjacentCells) {
  // Gas flows through the tube several times, driven by pressures at its ends: the density stays that of the masses.
  std::string scene = implicitly(twoGases);
  for (const auto& [side, pressure] : {std::pair("x-", "1"), std::pair("x+", "0.9")})
    scene = changedScene(
        scene, fmt::format("<Face side=\"{}\"><BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/>", side),
        fmt::format("<Face side=\"{}\"><BCType id=\"all\" label=\"Pressure\" var=\"Dirichlet\"><value>{}"
                    "</value></BCType>",
                    side, pressure));
  const report::Report report =
      test::runScene(scene, {"Grid/Level/Box/resolution=[50,1,1]", "CFD/cfl=0.25", "Time/maxTime=8"});
  EXPECT_LT(report.steps, 1400);
  EXPECT_LT(std::abs(driftOf(report, "mass")), 1);
}

TEST(ImplicitMixture, HasOneFingerprintOnAnyPatches) {
  Overrides overrides = cells(24, 16);
  overrides.push_back("Time/maxTime=0.2");
  const std::string whole = test::runScene(slow, overrides).fingerprint;
  for (const char* patches : {"[2,1,1]", "[3,4,1]"}) {
    Overrides cut = overrides;
    cut.push_back("Grid/Level/Box/patches=" + std::string(patches));
    EXPECT_EQ(test::runScene(slow, cut).fingerprint, whole) << patches;
  }
}

TEST(ImplicitMixture, KeepsLayersAtRest) {
  // Air of 300 K in layers; half of it has another name.
  const std::string whole = "<min>[0,0,0]</min><max>[1,2,1]</max></box>", half = "<volumeFraction>0.5</volumeFraction>";
  const std::string density = "<density>101325*exp(-9.81*y/(287*300))/(287*300)</density>";
  std::string scene = changedScene(
      "ups/ice/hot_bubble.ups", "<material name=\"gas\">",
      "<material name=\"other\"><EOS type=\"ideal_gas\"/><gamma>1.4</gamma><specific_heat>717.5</specific_heat>"
      "<geom_object><box label=\"half\">" +
          whole + half + density +
          "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object></material><material "
          "name=\"gas\">");
  scene = changedScene(scene, whole + "\n", whole + half + "\n");
  scene = changedScene(scene, "(287*(300 + 30*exp(-((x-0.5)^2 + (y-0.4)^2)/0.02)))", "(287*300)");
  scene = changedScene(scene, "<temperature>300 + 30*exp(-((x-0.5)^2 + (y-0.4)^2)/0.02)", "<temperature>300");
  const report::Report report = test::runScene(scene, {"Grid/Level/Box/resolution=[4,32,1]"});
  EXPECT_NEAR(driftOf(report, "momentum"), 0, 1e-6);
  EXPECT_NEAR(driftOf(report, "mass"), 0, 1e-14);
  EXPECT_LT(report.steps, 200);
}

TEST(ImplicitMixture, RefusesSeveralLevels) {
  EXPECT_EQ(problemOf(changedScene(implicitly(twoGases), "    </Level>\n",
                                   "    </Level>\n    <Level><Box label=\"fine\"><lower>[0.25,0,0]</lower>"
                                   "<upper>[0.5,1,1]</upper><resolution>[100,1,1]</resolution></Box></Level>\n")),
            "'ice' needs a grid of one level: an <ImplicitSolver> solves for the pressure on one level; "
            "CFD/ICE/explicit=true switches it off");
}

}  // namespace tushar::ice
