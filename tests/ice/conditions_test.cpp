#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/support/scenes.hpp"

// Conditions, forces and viscosities given by tags of Uintah's ICE.

namespace tushar::ice {

namespace {

using Overrides = std::vector<std::string>;
using test::changedScene;
using test::problemOf;

const std::string sod = "ups/ice/sod.ups", channel = "ups/ice/channel.ups", pulse = "ups/ice/pulse.ups",
                  shear = "ups/ice/shear_wave.ups";
const std::string symmetricSide = R"(<Face side="x-"><BCType id="all" label="Symmetric" var="symmetry"/></Face>)";

/// Sod's scene with other conditions on x-, and the sections that these need.
std::string withSide(const std::string& conditions, const std::string& sections = "") {
  return changedScene(sod, symmetricSide, sections + "<Face side=\"x-\">" + conditions + "</Face>");
}
std::string condition(const std::string& label, const std::string& var, const std::string& value = "0") {
  return "<BCType id=\"0\" label=\"" + label + "\" var=\"" + var + "\"><value>" + value + "</value></BCType>";
}

std::string fingerprintOf(const std::string& scene, const Overrides& overrides = {}) {
  return test::runScene(scene, overrides).fingerprint;
}
double errorOf(const std::string& scene, const Overrides& overrides = {}) {
  return test::runScene(scene, overrides).errors.at(0).norms.at("max");
}

}  // namespace

TEST(IceConditions, AWallThatSlipsIsAPlaneOfSymmetry) {
  EXPECT_EQ(fingerprintOf(withSide(condition("Velocity", "FreeSlipWall", "[0,0,0]"))), fingerprintOf(sod));
  EXPECT_EQ(problemOf(withSide(condition("Pressure", "FreeSlipWall"))),
            "var: 'FreeSlipWall' applies only to a Velocity");
}

TEST(IceConditions, APressureSwingsAsAFormulaSays) {
  const std::string section =
      "<SINE_BC><omega>20</omega><A>0.1</A><reference_pressure>1</reference_pressure></SINE_BC>";
  const std::string given = fingerprintOf(withSide(condition("Pressure", "Dirichlet", "1 + 0.1 * sin(20 * t)")));
  EXPECT_EQ(fingerprintOf(withSide(condition("Pressure", "Sine") + condition("Temperature", "Sine"), section)), given);
  EXPECT_EQ(problemOf(withSide(condition("Pressure", "Sine"))), "needs a <SINE_BC> in <BoundaryConditions>");
  EXPECT_EQ(problemOf(withSide(condition("Density", "Sine"), section)),
            "var: 'Sine' applies only to a Pressure, a Velocity or a Temperature");
  EXPECT_EQ(problemOf(withSide(condition("Temperature", "Sine"), section)),
            "var Sine for the Temperature needs var Sine for the Pressure or the Velocity");
}

TEST(IceConditions, OnlyComponentsOfVelocitiesThatAreThereSwing) {
  const std::string section =
      "<SINE_BC><omega>20</omega><A>0.1</A><reference_velocity>[0.5,0,0]</reference_velocity></SINE_BC>";
  EXPECT_EQ(fingerprintOf(withSide(condition("Velocity", "Sine", "[0,0,0]"), section)),
            fingerprintOf(withSide(condition("Velocity", "Dirichlet", "[0.5 + 0.1 * sin(20 * t), 0, 0]"))));
  EXPECT_EQ(
      problemOf(withSide(condition("Velocity", "Sine", "[0,0,0]"), "<SINE_BC><omega>20</omega><A>0.1</A></SINE_BC>")),
      "needs a <reference_velocity> in <SINE_BC>: components of 0 do not oscillate");
}

TEST(IceConditions, WavesLeaveByAllSides) {
  // Relative to a height of 1e-3 Pa.
  EXPECT_LT(errorOf(pulse), 2e-5);
  EXPECT_EQ(fingerprintOf(pulse, {"Grid/Level/Box/patches=[4,2,1]"}), fingerprintOf(pulse));
  EXPECT_EQ(problemOf(withSide(condition("Pressure", "LODI"))), "needs a <LODI> in <BoundaryConditions>");
}

namespace {

/// The ring of sound in two gases of one law or of two, whose shares vary: a tenth to a half of the first.
std::string pulseOfTwo(const std::string& gamma, const std::string& specificHeat, const std::string& tags = "") {
  std::stringstream text;
  text << std::ifstream(pulse).rdbuf();
  const std::string whole = text.str(), end = "</geom_object>\n      </material>";
  const std::size_t at = whole.find("<material name"), to = whole.find(end) + end.size();
  std::string other = whole.substr(at, to - at);
  const auto change = [&](std::string& of, const std::string& from, const std::string& by) {
    of.replace(of.find(from), from.size(), by);
  };
  std::string first = other;
  change(first, "<density>", "<volumeFraction>0.3 + 0.4*x*y</volumeFraction><density>");
  change(other, "<density>", "<volumeFraction>0.7 - 0.4*x*y</volumeFraction><density>");
  change(other, "name=\"gas\"", "name=\"other\"");
  change(other, "label=\"all\"", "label=\"all of it\"");
  change(other, "<gamma>1.4<", "<gamma>" + gamma + "<");
  change(other, "<specific_heat>2.5<", "<specific_heat>" + specificHeat + "<");
  const std::string scene = changedScene(pulse, whole.substr(at, to - at), first + other);
  return tags.empty() ? scene : changedScene(scene, "<TimeStepControl>", tags);
}

}  // namespace

TEST(IceConditions, WavesLeaveInSeveralGases) {
  const std::string twice = pulseOfTwo("1.4", "2.5");
  EXPECT_NEAR(errorOf(twice) / errorOf(pulse), 1, 1e-3);
  EXPECT_EQ(fingerprintOf(twice, {"Grid/Level/Box/patches=[4,2,1]"}), fingerprintOf(twice));
  EXPECT_LT(errorOf(pulseOfTwo("1.6", "1.6666666666666667")), 2e-4);  // it starts with differences of density
  EXPECT_LT(errorOf(pulseOfTwo("1.4", "2.5",
                               "<ImplicitSolver/><TimeStepControl><knob_for_speedSound>1</knob_for_speedSound>")),
            1e-4);
}

TEST(IceConditions, DoNotContradictOneAnother) {
  const std::string slip = condition("Velocity", "FreeSlipWall", "[0,0,0]"), waves = condition("Pressure", "LODI");
  const std::string section = "<LODI><press_infinity>1</press_infinity></LODI>";
  EXPECT_EQ(problemOf(withSide(slip + condition("Temperature", "Dirichlet", "1"))),
            "a FreeSlipWall is a plane of symmetry, so it takes no other condition");
  EXPECT_EQ(problemOf(withSide(condition("Density", "LODI"), section)),
            "var LODI for another variable needs var LODI for the Pressure");
  EXPECT_EQ(problemOf(withSide(waves + condition("Density", "Dirichlet", "1"), section)),
            "with var LODI for the Pressure, only a Temperature may be given as well");
  EXPECT_EQ(problemOf(withSide(waves + condition("Temperature", "Dirichlet", "1"), section)), "");
  EXPECT_EQ(problemOf(withSide(waves + slip, section)),
            "a FreeSlipWall is a plane of symmetry, so it takes no other condition");
  const std::string sine =
      "<SINE_BC><omega>20</omega><A>0.1</A><reference_velocity>[1,0,0]</reference_velocity></SINE_BC>";
  EXPECT_EQ(problemOf(withSide(waves + condition("Velocity", "Sine", "[0,0,0]"), section + sine)),
            "with var LODI for the Pressure, only a Temperature may be given as well");
}

TEST(IceConditions, WavesLeaveInImplicitSteps) {
  const std::string implicit = changedScene(pulse, "<TimeStepControl>",
                                            "<ImplicitSolver/><TimeStepControl>"
                                            "<knob_for_speedSound>1</knob_for_speedSound>");
  EXPECT_LT(errorOf(implicit), 1e-4);
}

TEST(IceForces, AGradientOfPressureDrivesAChannelAsGravityDoes) {
  const std::string driven =
      changedScene(channel, "<TimeStepControl>",
                   "<fixedPressureGradient><x_dir>0.04</x_dir></fixedPressureGradient><TimeStepControl>");
  const Overrides coarse{"Grid/Level/Box/resolution=[8,8,1]", "PhysicalConstants/gravity=[0,0,0]"};
  EXPECT_NEAR(errorOf(driven, coarse), 0.05 / 64, 2e-5);
}

TEST(IceViscosity, OfEddiesDampsAWave) {
  const auto with = [](const std::string& constant) {
    return changedScene(shear, "<TimeStepControl>",
                        "<turbulence model=\"Smagorinsky\"><model_constant>" + constant +
                            "</model_constant></turbulence><TimeStepControl>");
  };
  EXPECT_EQ(fingerprintOf(with("0")), fingerprintOf(shear));
  const Overrides shortened{"Time/max_Timesteps=20"};
  EXPECT_NE(fingerprintOf(with("0.2"), shortened), fingerprintOf(shear, shortened));
  Overrides patches = shortened;
  patches.emplace_back("Grid/Level/Box/patches=[4,2,1]");
  EXPECT_EQ(fingerprintOf(with("0.2"), patches), fingerprintOf(with("0.2"), shortened));
  EXPECT_NEAR(test::driftOf(test::runScene(with("0.2"), shortened), "energy"), 0, 1e-14);
  EXPECT_EQ(problemOf(changedScene(
                sod, "<ICE><advection",
                "<ICE><turbulence model=\"Germano\"><model_constant>1</model_constant></turbulence><advection")),
            "attribute 'model': found 'Germano', expected 'Smagorinsky'");
}

TEST(IceViscosity, OfModelsIsRead) {
  const auto with = [](const std::string& models) {
    return changedScene(sod, "<EOS type=\"ideal_gas\"/>",
                        "<EOS type=\"ideal_gas\"/><dynamicViscosityModels>" + models + "</dynamicViscosityModels>");
  };
  const std::string sutherland = "<Model name=\"Sutherland\"><a>1</a><b>1</b></Model>";
  const std::string sponge =
      "<Model name=\"SpongeLayer\"><maxDynamicViscosity>1</maxDynamicViscosity><box label=\"b\">"
      "<min>[0,0,0]</min><max>[1,1,1]</max></box></Model>";
  EXPECT_EQ(problemOf(with(sutherland + sponge + sponge)), "");
  EXPECT_EQ(problemOf(with(sponge + sutherland)), "give Sutherland once, and before any SpongeLayer");
  EXPECT_EQ(problemOf(with("")), "is empty: it needs at least one Model");
  EXPECT_EQ(problemOf(with("<Model name=\"SpongeLayer\"><maxDynamicViscosity>1</maxDynamicViscosity><box label=\"b\">"
                           "<min>[0,1,0]</min><max>[1,0,1]</max></box></Model>")),
            "the <box> is empty: each number of <min> must be less than the corresponding one of <max>");
  EXPECT_EQ(problemOf(with("<Model name=\"Power\"/>")), "name: found 'Power', expected 'Sutherland' or 'SpongeLayer'");
}

namespace {

/// The notes of Sod's scene with these conditions on x-.
std::string notesOf(const std::string& scene) {
  std::string all;
  for (const InputProblem& note : scene::readScene(scene, {}, catalogue()).notes) all += note.sentence + '\n';
  return all;
}

}  // namespace

TEST(IceConditions, OfScalarsThatAreNotThereDoNothing) {
  const std::string idle = "does nothing: the scene has no scalar ";
  EXPECT_NE(notesOf(withSide(condition("scalar-f", "Dirichlet", "1"))).find(idle + "'f'"), std::string::npos);
  EXPECT_NE(notesOf(withSide(condition("scalar-q_CC", "Dirichlet", "1"))).find(idle + "'q'"), std::string::npos);
}

TEST(IceConditions, WithoutSidesForThemConstantsDoNothing) {
  const std::string lodi = "<LODI><press_infinity>1</press_infinity></LODI>", sine = "<SINE_BC/>";
  EXPECT_NE(notesOf(withSide("", lodi)).find("does nothing: no side has var LODI"), std::string::npos);
  EXPECT_NE(notesOf(withSide("", sine)).find("does nothing: no side has var Sine"), std::string::npos);
  EXPECT_EQ(notesOf(withSide(condition("Pressure", "LODI"), lodi)).find("no side has"), std::string::npos);
}

TEST(IceConditions, AVortexMovesNothingAlongAnAxisWithOneCell) {
  const auto vortex = [](const std::string& axis) {
    return notesOf(changedScene(shear, "<advection type=\"SecondOrder\"/>",
                                "<advection type=\"SecondOrder\"/><customInitialization><vortices><vortex><axis>" +
                                    axis +
                                    "</axis><origin>[0,0,0]</origin><strength>1</strength><radius>1</radius></vortex>"
                                    "</vortices></customInitialization>"));
  };
  EXPECT_NE(vortex("X").find("does nothing along z, along which the grid has one cell"), std::string::npos);
  EXPECT_EQ(vortex("Z").find("does nothing along z"), std::string::npos);
}

TEST(IceConditions, AllowTensionInAStiffenedGas) {
  const std::string water = "<EOS type=\"stiffened_gas\"><p_infinity>2</p_infinity></EOS>";
  const auto stiff = [&](const std::string& scene) {
    const std::string module = "<gamma>1.4</gamma>\n      <diaphragm>";
    return changedScene(changedScene(scene, "<EOS type=\"ideal_gas\"/>", water), module,
                        "<gamma>1.4</gamma><p_infinity>2</p_infinity><diaphragm>");
  };
  const auto lodi = [&](const std::string& pressure) {
    return withSide(condition("Pressure", "LODI"), "<LODI><press_infinity>" + pressure + "</press_infinity></LODI>");
  };
  EXPECT_EQ(problemOf(stiff(withSide(condition("Pressure", "Dirichlet", "-0.5")))), "");
  EXPECT_EQ(problemOf(stiff(withSide(condition("Pressure", "Dirichlet", "-2")))),
            "found '-2', expected a value greater than -2 Pa");
  EXPECT_EQ(problemOf(withSide(condition("Pressure", "Dirichlet", "-0.5"))),
            "found '-0.5', expected a value greater than 0 Pa");
  EXPECT_EQ(problemOf(stiff(lodi("-0.5"))), "");
  EXPECT_EQ(problemOf(lodi("-0.5")), "found '-0.5', expected a value greater than 0 Pa");
}

}  // namespace tushar::ice
