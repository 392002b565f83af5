#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

// BinaryProperties, and programmed burns.

namespace tushar::ice {

namespace {

using test::changedScene;
using test::driftOf;
using test::problemOf;

const std::string sod = "ups/ice/sod.ups", gases = "ups/ice/two_gases.ups";

/// The tube of sod.ups with two gases A and B with these constants; B is in the `regions`.
std::string binary(const std::string& constants, const std::string& regions, const std::string& module) {
  std::string scene = changedScene(
      sod, "  <DataAnalysis>",
      "  <Models><Model type=\"BinaryProperties\"><BinaryProperties><material>gas</material>"
      "<scalar name=\"f\"><constants>" +
          constants + "</constants>" + regions + "</scalar></BinaryProperties></Model></Models>\n  <DataAnalysis>");
  if (module.empty()) return scene;
  scene = changedScene(scene, "<Module name=\"exactRiemann\">", "<Module name=\"exactSolution\">" + module);
  scene = changedScene(scene, "<left><density>1</density><pressure>1</pressure></left>", "");
  scene = changedScene(scene, "<right><density>0.125</density><pressure>0.1</pressure></right>", "");
  return changedScene(changedScene(scene, "<gamma>1.4</gamma>\n      <diaphragm>0.5</diaphragm>", ""),
                      "<temperature>0.8<", "<temperature>1<");
}

std::string region(const std::string& least, const std::string& most, const std::string& fraction) {
  return "<geom_object><box label=\"of" + least + "\"><min>[" + least + ",0,0]</min><max>[" + most +
         ",1,1]</max></box><scalar>" + fraction + "</scalar></geom_object>";
}

std::string variable(const std::string& label, const std::string& value) {
  return "<label>" + label + "</label><value>" + value + "</value>";
}

double greatestError(const std::string& scene, const std::vector<std::string>& overrides) {
  return test::runScene(scene, overrides).errors.at(0).norms.at("max");
}

// gamma of A 1.5, of B 1.25.
const std::string unlike = "<rho_A>1</rho_A><rho_B>0.5</rho_B><cv_A>2</cv_A><cv_B>8</cv_B><R_A>1</R_A><R_B>2</R_B>";

}  // namespace

TEST(BinaryProperties, HaveNoExchangeOfTheirOwn) {
  const std::string plain = binary(unlike, region("0", "1", "0.25"), variable("c.density", "0.8"));
  const std::string given = changedScene(plain, "</ICE>\n  </MaterialProperties>",
                                         "</ICE><exchange_properties><exchange_coefficients><momentum>[1e15]</momentum>"
                                         "<heat>[0]</heat></exchange_coefficients></exchange_properties>"
                                         "</MaterialProperties>");
  const simulation::Problem problem = scene::readScene(given, {}, catalogue());
  EXPECT_TRUE(std::any_of(problem.notes.begin(), problem.notes.end(), [](const InputProblem& note) {
    return note.sentence.find("have one velocity and one temperature") != std::string::npos;
  }));
}

TEST(BinaryProperties, AreThoseOfTheMixture) {
  // f = .25: c_v = 3.5, R = 1.25, 1 / rho = .75 / 1 + .25 / .5.
  const std::vector<std::string> start{"Time/max_Timesteps=3"};
  const double rho = 0.8, p = rho * 1.25, gamma = 1 + 1.25 / 3.5;
  for (const auto& [label, value] :
       {std::pair("c.density", rho), std::pair("c.pressure", p), std::pair("c.soundSpeed", std::sqrt(gamma * p / rho)),
        std::pair("c.temperature", 1.0), std::pair("c.massFraction", 0.25)})
    EXPECT_LT(
        greatestError(binary(unlike, region("0", "1", "0.25"), variable(label, fmt::format("{:.17g}", value))), start),
        1e-14)
        << label;
}

TEST(BinaryProperties, HaveTheWavesOfOneGas) {
  // Both have gamma 1.4; a tube of one density, with T = 2/3 and 1/15, p = 1 and .1.
  const std::string like = "<rho_A>1</rho_A><rho_B>1</rho_B><cv_A>2.5</cv_A><cv_B>5</cv_B><R_A>1</R_A><R_B>2</R_B>";
  std::string scene = binary(like, region("0", "0.3", "0.5") + region("0.3", "1", "0.5"), "");
  scene = changedScene(scene, "<temperature>1<", "<temperature>0.66666666666666667<");
  scene = changedScene(scene, "<temperature>0.8<", "<temperature>0.066666666666666667<");
  scene = changedScene(scene, "<right><density>0.125<", "<right><density>1<");
  const report::Report mixed = test::runScene(scene, {});
  scene =
      changedScene(changedScene(sod, "<right><density>0.125<", "<right><density>1<"), "<density>0.125<", "<density>1<");
  const report::Report alone = test::runScene(changedScene(scene, "<temperature>0.8<", "<temperature>0.1<"), {});
  EXPECT_NEAR(mixed.errors.at(0).norms.at("L1") / alone.errors.at(0).norms.at("L1"), 1, 0.05);
  EXPECT_NEAR(driftOf(mixed, "energy"), 0, 1e-13);
}

TEST(BinaryProperties, StayAtOnePressureWhereTheyMix) {
  const std::string blob = region("0.3", "0.6", "1");
  const std::string moving = "<temperature>1</temperature><velocity>[0.5,0,0]</velocity>";
  for (const auto& [label, value] : {std::pair("c.pressure", "1"), std::pair("c.temperature", "1")}) {
    std::string scene = binary(unlike, blob, variable(label, value));
    scene = changedScene(scene, "<temperature>1</temperature>", moving);
    scene = changedScene(scene, "<temperature>1</temperature>\n        </geom_object>\n      </material>",
                         moving + "</geom_object></material>");
    for (const char* side : {"x-", "x+"})
      scene = changedScene(scene, fmt::format("<Face side=\"{}\"><BCType id=\"all\" label=\"Symmetric\"", side),
                           fmt::format("<Face side=\"{}\"><BCType id=\"all\" label=\"Pressure\"", side));
    for (int k = 0; k < 2; ++k)
      scene = changedScene(scene, "label=\"Pressure\" var=\"symmetry\"/>",
                           "label=\"Pressure\" var=\"Neumann\"><value>0</value></BCType>");
    EXPECT_LT(greatestError(scene, {}), 1e-12) << label;
    EXPECT_LT(greatestError(changedScene(scene, "<ICE><advection type=\"SecondOrder\"/></ICE>",
                                         "<ICE><advection type=\"SecondOrder\"/><ImplicitSolver/></ICE>"),
                            {}),
              1e-8)
        << label;
  }
}

TEST(BinaryProperties, AreRefusedWhereTheyHaveNoMeaning) {
  const std::string all = region("0", "1", "0.25");
  EXPECT_EQ(problemOf(binary(unlike + "<diffusivity>1</diffusivity>", all, "")),
            "found '1', expected 0, 0.0, 0., 0.0e0: the gases do not diffuse into each other");
  EXPECT_EQ(problemOf(binary(unlike, region("0", "1", "1.5"), "")), "found '1.5', expected a value of at most 1");
  EXPECT_EQ(problemOf(changedScene(binary(unlike, all, ""), "<material>gas<", "<material>air<")),
            "material: found 'air', expected 'gas', the name of the gas");
}

TEST(BinaryProperties, NoteTheOtherPropertiesOfTheirGas) {
  const auto notesOf = [](const std::string& tags) {
    int count = 0;
    const std::string scene = changedScene(binary(unlike, region("0", "1", "0.25"), variable("c.density", "0.8")),
                                           "<gamma>1.4</gamma>", tags);
    for (const InputProblem& note : scene::readScene(scene, {}, catalogue()).notes)
      count += note.sentence == "does nothing: it follows from the <constants> of BinaryProperties" ? 1 : 0;
    return count;
  };
  // The scene gives a c_v of 2.5, and densities of 1 and .125; those of A are 2 and 1.
  EXPECT_EQ(notesOf("<gamma>1.5</gamma>"), 2) << "of c_v and of one density";
  EXPECT_EQ(notesOf("<gamma>1.4</gamma>"), 3);
}

TEST(BinaryProperties, GetHeatTogether) {
  // From t = 0 on, a box at rest with the energy c_v T = 3.5 per mass is heated by 3 W/kg.
  std::string scene = binary(unlike, region("0", "1", "0.25"), variable("c.pressure", "1"));
  scene = changedScene(scene, "<ICE><advection type=\"SecondOrder\"/>",
                       "<ICE><advection type=\"SecondOrder\"/><ADD_HEAT><add_heat_matls>[0]</add_heat_matls>"
                       "<add_heat_coeff>[3]</add_heat_coeff><add_heat_t_start>0</add_heat_t_start>"
                       "<add_heat_t_final>9</add_heat_t_final></ADD_HEAT>");
  const report::Report report = test::runScene(scene, {});
  EXPECT_NEAR(driftOf(report, "energy"), 3 * report.time / 3.5, 1e-12);
}

TEST(ProgrammedBurn, RunsThroughAGasAtItsSpeed) {
  // The detonation starts at x = 0 and travels at 2 m/s until t = .2, so the gas below x = .4 has burned, except for
  // 1.5 cells. Both gases have one law and one pressure, so that hardly anything moves; the sum of the heat, which is
  // small, tells how much has burned.
  std::string scene = changedScene(gases, "  <DataAnalysis>",
                                   "  <Models><Model type=\"LightTime\"><LightTime><fromMaterial>air</fromMaterial>"
                                   "<toMaterial>helium</toMaterial><D>2</D><E0>1e-3</E0><starting_location>[0,0,0]"
                                   "</starting_location><direction_if_plane>[1,0,0]</direction_if_plane></LightTime>"
                                   "</Model></Models>\n  <DataAnalysis>");
  const std::string helium = "MaterialProperties/ICE/material[2]/";
  const double width = 0.005, energy = 2.5;  // m; J/m³ at the pressure 1 Pa
  const auto burned = [&](const char* across) {
    const report::Report report =
        test::runScene(scene, {fmt::format("Grid/Level/Box/upper=[1,{0},{0}]", across), helium + "gamma=1.4",
                               helium + "specific_heat=2.5", helium + "geom_object/temperature=8",
                               "DataAnalysis/Module/right/gamma=1.4"});
    EXPECT_NEAR(driftOf(report, "mass"), 0, 1e-14);
    return driftOf(report, "energy") * energy / 1e-3;
  };
  EXPECT_NEAR(burned("0.005"), 0.4, 1.5 * width);
  EXPECT_NEAR(burned("0"), burned("0.005"), 1e-9) << "cells have the width along the axes that the grid uses";
  // The burn is that at the end of a step: of the first cell, at the distance of half a width, (D t - .5 h) / (1.5 h)
  // has burned after three steps.
  const report::Report step = test::runScene(
      scene, {"Grid/Level/Box/upper=[1,0.005,0.005]", helium + "gamma=1.4", helium + "specific_heat=2.5",
              helium + "geom_object/temperature=8", "DataAnalysis/Module/right/gamma=1.4", "Time/max_Timesteps=3"});
  EXPECT_NEAR(driftOf(step, "energy") * energy / 1e-3, width * (2 * step.time / width - 0.5) / 1.5, 1e-9);
  EXPECT_EQ(problemOf(changedScene(scene, "<toMaterial>helium", "<toMaterial>air")), "a gas cannot become itself");
}

}  // namespace tushar::ice
