#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace tushar::ice {

namespace {

using Overrides = std::vector<std::string>;
using test::changedScene;

const std::string sod = "ups/ice/sod.ups", shear = "ups/ice/shear_wave.ups", channel = "ups/ice/channel.ups",
                  heat = "ups/ice/heat_wave.ups", jwlShock = "ups/ice/jwl_shock.ups",
                  murnaghanShock = "ups/ice/murnaghan_shock.ups";

using test::driftOf;

/// The problem of the scene, without its place; if there is none, its note.
std::string problemOf(const std::string& scene, const Overrides& overrides = {}) {
  try {
    const simulation::Problem problem = scene::readScene(scene, overrides, catalogue());
    std::string notes;
    for (const InputProblem& note : problem.notes)
      if (note.sentence.find("is saved as") == std::string::npos) notes += note.sentence;
    return notes;
  } catch (const InputError& error) {
    return error.problems().size() == 1 ? error.problems()[0].sentence : std::string(error.what());
  }
}

double errorOf(const std::string& scene, const Overrides& overrides) {
  return test::runScene(scene, overrides).errors.at(0).norms.at("max");
}

const std::string side = R"(<Face side="x-"><BCType id="all" label="Symmetric" var="symmetry"/></Face>)";

/// Sod's scene with other conditions at x-.
std::string withSide(const std::string& conditions) {
  return changedScene(sod, side, "<Face side=\"x-\">" + conditions + "</Face>");
}

}  // namespace

TEST(IceScene, HasTheBitsOfEuler) {
  // With gamma = 1.5 and c_v = 2, R is exactly 1.
  const std::string gamma = "DataAnalysis/Module/gamma=1.5";
  EXPECT_EQ(test::runScene(sod, {"MaterialProperties/ICE/material/gamma=1.5",
                                 "MaterialProperties/ICE/material/specific_heat=2", gamma})
                .fingerprint,
            test::runScene("ups/euler/sod.ups", {"Euler/gas/gamma=1.5", "Euler/cfl=0.4", gamma}).fingerprint);
}

TEST(IceScene, TakesLongerStepsIfCflLimitsTheRateAlongEachAxis) {
  const std::string scheme = "CFD/ICE/TimeStepControl/Scheme_for_delT_calc=", cells = "Grid/Level/Box/resolution=";
  const auto steps = [&](const std::string& scene, const std::string& words) {
    return test::runScene(scene, {scheme + words, cells + "[16,16,1]"}).steps;
  };
  // With cfl .4, the sum over two axes may be .8; in implicit steps .5.
  for (const char* scene : {"ups/ice/pulse.ups", "ups/ice/three_gases.ups"})
    EXPECT_NEAR(steps(scene, "conservative") / static_cast<double>(steps(scene, "aggressive")), 2, 0.05) << scene;
  for (const char* scene : {"ups/ice/vortex_slow.ups", "ups/ice/slow_gases.ups"}) {
    EXPECT_LT(steps(scene, "aggressive"), steps(scene, "conservative")) << scene;
    EXPECT_GE(1.3 * steps(scene, "aggressive"), steps(scene, "conservative")) << scene;
  }
}

TEST(IceScene, RepeatsAStepThatLeavesAnImpossibleState) {
  // Cold gas that leaves the middle of the box at 20 m/s; its speed of sound is .12 m/s.
  std::string scene = changedScene("ups/ice/pulse.ups", "<density>(1+0.001*exp(-100*(x*x+y*y)))^(1/1.4)</density>",
                                   "<density>1</density><velocity>[20*x/(1e-9+sqrt(x*x+y*y)),"
                                   "20*y/(1e-9+sqrt(x*x+y*y)),0]</velocity>");
  scene = changedScene(scene, "<temperature>(1+0.001*exp(-100*(x*x+y*y)))^(0.4/1.4)<", "<temperature>0.01<");
  const report::Report report = test::runScene(scene, {"CFD/ICE/TimeStepControl/Scheme_for_delT_calc=aggressive",
                                                       "Grid/Level/Box/resolution=[16,16,1]", "Time/maxTime=0.05"});
  EXPECT_GT(report.retries, 0);
  EXPECT_NEAR(report.time, 0.05, 1e-12);
}

TEST(IceScene, KeepsTheEnergyOfSodsTube) { EXPECT_NEAR(driftOf(test::runScene(sod, {}), "energy"), 0, 1e-14); }

TEST(IceScene, DampsAShearWave) {
  // .0067 m/s remain; second order in h, with steps proportional to h².
  const double coarse = errorOf(shear, {"Grid/Level/Box/resolution=[32,8,1]"});
  const double fine = errorOf(shear, {});
  EXPECT_LT(fine, 1.6e-6);
  EXPECT_GT(coarse / fine, 4);
  EXPECT_NEAR(driftOf(test::runScene(shear, {}), "energy"), 0, 1e-14);
}

TEST(IceScene, KeepsMomentumAndEnergyOfAPeriodicBox) {
  const report::Report report = test::runScene(
      shear,
      {"Time/max_Timesteps=50", "MaterialProperties/ICE/material/thermal_conductivity=0.1",
       "MaterialProperties/ICE/material/geom_object/velocity=[0.3+0.1*sin(2*pi*x)*cos(16*pi*y),0.2*cos(2*pi*x),0]"});
  for (const char* name : {"mass", "momentum", "energy"}) EXPECT_NEAR(driftOf(report, name), 0, 1e-14) << name;
}

TEST(IceScene, DampsAWaveOfTemperature) {
  // .0454 K of it remain.
  EXPECT_LT(errorOf(heat, {}), 2.3e-4);
}

TEST(IceScene, HasTheParabolaOfAChannel) {
  EXPECT_NEAR(errorOf(channel, {"Grid/Level/Box/resolution=[8,8,1]"}), 0.05 / 64, 1e-5);
}

TEST(IceScene, HasOneFingerprintOnAnyPatches) {
  const Overrides shortened{"Time/maxTime=0.02"};
  for (const std::string& scene : {shear, channel}) {
    const std::string whole = test::runScene(scene, shortened).fingerprint;
    for (const char* patches : {"[2,1,1]", "[1,4,1]", "[4,8,1]"}) {
      Overrides overrides = shortened;
      overrides.push_back("Grid/Level/Box/patches=" + std::string(patches));
      EXPECT_EQ(test::runScene(scene, overrides).fingerprint, whole) << scene << patches;
    }
  }
}

TEST(IceScene, KeepsEnergyOnTwoLevels) {
  const std::string scene =
      changedScene(heat, "    </Level>\n",
                   "    </Level>\n    <Level><Box label=\"fine\"><lower>[0.25,0,0]</lower><upper>[0.5,1,1]</upper>"
                   "<resolution>[32,1,1]</resolution></Box></Level>\n");
  const report::Report report = test::runScene(scene, {"Time/maxTime=0.1"});
  EXPECT_NEAR(driftOf(report, "energy"), 0, 1e-14);
  EXPECT_NEAR(driftOf(report, "mass"), 0, 1e-14);
}

TEST(IceScene, TakesNeumannConditionsForAnOpenSide) {
  const std::string open = R"(<BCType id="0" label="Pressure" var="Neumann"><value>0.0</value></BCType>)"
                           R"(<BCType id="0" label="Velocity" var="Neumann"><value>[0.,0.,0.]</value></BCType>)"
                           R"(<BCType id="0" label="SpecificVol" var="computeFromDensity"><value>0.0</value></BCType>)";
  EXPECT_EQ(test::runScene(withSide(open), {}).fingerprint, test::runScene(withSide(""), {}).fingerprint);
  EXPECT_EQ(problemOf(withSide(open)), "");
}

TEST(IceScene, RefusesAGradientAtASide) {
  EXPECT_EQ(problemOf(withSide(R"(<BCType id="0" label="Density" var="Neumann"><value>1</value></BCType>)")),
            "found '1', expected 0: a Neumann condition extends Density unchanged beyond the grid");
}

TEST(IceScene, RefusesAnInflowOfNoTemperature) {
  EXPECT_EQ(problemOf(withSide(R"(<BCType id="0" label="Temperature" var="Dirichlet"><value>0</value></BCType>)")),
            "found '0', expected a value greater than 0 K");
}

TEST(IceScene, RefusesConditionsOfAnotherMaterial) {
  EXPECT_EQ(problemOf(withSide(R"(<BCType id="1" label="Density" var="Dirichlet"><value>1</value></BCType>)")),
            "there is no material 1: the gas has index 0");
}

TEST(IceScene, TakesConditionsOnAPartOfASide) {
  EXPECT_EQ(problemOf(changedScene(sod, "<Face side=\"x-\">", "<Face circle=\"x-\" origin=\"0 0 0\" radius=\"1\">")),
            "");
}

TEST(IceScene, RefusesAShareOfAGasAlone) {
  EXPECT_EQ(
      problemOf(changedScene(sod, "<density>1</density>", "<volumeFraction>0.5</volumeFraction><density>1</density>")),
      "found '0.5', expected 1: a single gas fills the region");
}

TEST(IceScene, RefusesSolids) {
  EXPECT_EQ(problemOf(changedScene(sod, "<MaterialProperties>", "<MaterialProperties><MPM/>")),
            "'ice' has no solids: keep only the gas");
}

TEST(IceScene, RefusesOtherEquationsOfState) {
  EXPECT_EQ(problemOf(changedScene(sod, "<EOS type=\"ideal_gas\"/>", "<EOS type=\"KnaussSeaWater\"><a>1</a></EOS>")),
            "attribute 'type': found 'KnaussSeaWater', expected 'ideal_gas', 'stiffened_gas', 'JWL', 'JWLC', "
            "'Murnaghan', 'Gruneisen', 'Thomsen_Hartka_water', 'TST' or 'hard_sphere_gas'");
}

TEST(IceScene, TellsWhichNumberOfAnEquationOfStateIsMissing) {
  const std::string numbers = "<B>1</B><R1>4</R1><R2>1</R2><om>.3</om><rho0>1</rho0>";
  EXPECT_EQ(problemOf(changedScene(sod, "<EOS type=\"ideal_gas\"/>", "<EOS type=\"JWL\">" + numbers + "</EOS>")),
            "missing tag <A> in <EOS> (factor of exp(-R1 rho0 / rho))");
}

TEST(IceScene, HasTheFrontOfAShockInProductsOfExplosives) {
  const std::string fine = "Grid/Level/Box/resolution=[400,1,1]";
  for (const std::string& scene : {jwlShock, murnaghanShock}) {
    const auto l1 = [&](const Overrides& overrides) {
      return test::runScene(scene, overrides).errors.at(0).norms.at("L1");
    };
    EXPECT_GT(l1({}) / l1({fine}), 1.9) << scene;
  }
  EXPECT_LT(test::runScene(jwlShock, {}).errors.at(0).norms.at("L1"), 3.5e6);
  EXPECT_LT(test::runScene(murnaghanShock, {}).errors.at(0).norms.at("L1"), 0.26);
}

TEST(IceScene, KeepsTheEnergyOfProductsOfExplosives) {
  const std::string closed =
      "<Face side=\"x-\"><BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/></Face>"
      "<Face side=\"x+\"><BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/></Face><Face side=\"y-\">";
  for (const std::string& scene : {jwlShock, murnaghanShock}) {
    const report::Report report = test::runScene(changedScene(scene, "<Face side=\"y-\">", closed), {});
    EXPECT_NEAR(driftOf(report, "mass"), 0, 1e-14) << scene;
    EXPECT_NEAR(driftOf(report, "energy"), 0, 1e-13) << scene;
  }
}

TEST(IceScene, OfOtherEquationsOfStateHasOneFingerprintOnAnyPatches) {
  for (const std::string& scene : {jwlShock, murnaghanShock})
    EXPECT_EQ(test::runScene(scene, {"Grid/Level/Box/patches=[5,1,1]"}).fingerprint,
              test::runScene(scene, {}).fingerprint);
}

TEST(IceScene, OfAStiffenedGasIsThatOfAnIdealOneOfHigherPressure) {
  // T is the same if p + p_infinity is; the pressures at the sides have no effect.
  const std::string stiff =
      changedScene(sod, "<EOS type=\"ideal_gas\"/>", "<EOS type=\"stiffened_gas\"><p_infinity>0.05</p_infinity></EOS>");
  const report::Report report =
      test::runScene(stiff, {"DataAnalysis/Module/p_infinity=0.05", "DataAnalysis/Module/left/pressure=0.95",
                             "DataAnalysis/Module/right/pressure=0.05"});
  EXPECT_NEAR(report.errors.at(0).norms.at("L1"), test::runScene(sod, {}).errors.at(0).norms.at("L1"), 1e-12);
}

TEST(IceScene, CarriesSoundThroughWater) {
  const auto l1 = [](const std::string& scene, const Overrides& overrides) {
    return test::runScene(scene, overrides).errors.at(0).norms.at("L1");
  };
  const std::string sound = "ups/ice/water_sound.ups", coarse = "Grid/Level/Box/resolution=[32,1,1]";
  EXPECT_LT(l1(sound, {}), 65);
  EXPECT_GT(l1(sound, {coarse}) / l1(sound, {}), 3.8);
  // Implicit steps are of first order: half the step, half the error.
  const std::string implicit = changedScene(
      sound, "<ICE><adv",
      "<ICE><ImplicitSolver/><TimeStepControl><knob_for_speedSound>1</knob_for_speedSound></TimeStepControl><adv");
  const double error = l1(implicit, {coarse, "CFD/cfl=0.2"});
  EXPECT_LT(error, 1300);
  EXPECT_GT(error / l1(implicit, {coarse, "CFD/cfl=0.1"}), 1.65);  // beside what the cells leave
  for (const char* name : {"mass", "energy"})
    EXPECT_NEAR(driftOf(test::runScene(implicit, {coarse, "CFD/cfl=0.2"}), name), 0, 1e-14) << name;
}

TEST(IceScene, RefusesImplicitStepsWhereThePressureDoesNotDependOnTheEnergy) {
  const std::string solver = "<ICE><ImplicitSolver/><advection";
  EXPECT_EQ(problemOf(changedScene(murnaghanShock, "<ICE><advection", solver)),
            "is not available with JWLC or Murnaghan, whose pressure does not depend on the energy: remove it, or run "
            "with --set "
            "CFD/ICE/explicit=true");
}

TEST(IceScene, RefusesExactSolutionsOfAnIdealGasForAnother) {
  const std::string scene = changedScene(sod, "<EOS type=\"ideal_gas\"/>",
                                         "<EOS type=\"JWL\"><A>1</A><B>1</B><R1>4</R1><R2>1</R2><om>.4</om>"
                                         "<rho0>1</rho0></EOS>");
  EXPECT_THROW(test::runScene(scene, {}), InputError);
}

TEST(IceScene, RefusesModels) {
  EXPECT_EQ(problemOf(changedScene(sod, "  <CFD>", "  <Models><Model type=\"DDT0\"/></Models>\n  <CFD>")),
            "the type 'DDT0' is not available; remove the model, or use one of PassiveScalar, Test, Simple_Burn, "
            "Steady_Burn, Unsteady_Burn, DDT1, JWLpp, LightTime, BinaryProperties, TracerParticles");
}

TEST(IceScene, NotesAPressureThatDensityAndTemperatureDoNotMake) {
  EXPECT_EQ(problemOf(changedScene(sod, "<density>0.125</density>", "<density>0.125</density><pressure>2</pressure>")),
            "does nothing: the pressure follows from density and temperature, and is 0.1 Pa");
  EXPECT_EQ(problemOf(changedScene(sod, "<density>0.125</density>", "<density>0.125</density><pressure>.1</pressure>")),
            "");
}

TEST(IceScene, SavesUintahsNamesAsItsOwnOnce) {
  simulation::Problem problem = scene::readScene(
      changedScene(sod, "<save label=\"rho_CC\"/>", "<save label=\"press_equil_CC\"/><save label=\"rho_CC\"/>"), {},
      catalogue());
  std::vector<std::string> labels;
  for (const simulation::SaveRequest& save : problem.archive.saves) labels.push_back(save.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"c.pressure", "c.density", "c.velocity", "c.temperature", "TotalMass",
                                              "TotalIntEng", "KineticEnergy"}));
}

TEST(IceScene, RefinesByUintahsNames) {
  const std::string adaptive =
      "<AMR><Regridder><max_levels>2</max_levels><min_patch_size>[[10,1,1]]</min_patch_size></Regridder>"
      "<ICE><Refinement_Criteria_Thresholds><Variable name=\"rho_CC\" value=\"0.01\" matl=\"0\"/>"
      "</Refinement_Criteria_Thresholds></ICE></AMR>";
  const simulation::Problem problem =
      scene::readScene(changedScene(sod, "  <CFD>", adaptive + "  <CFD>"), {"Grid/@doAMR=true"}, catalogue());
  ASSERT_EQ(problem.regrid.criteria.size(), 1U);
  EXPECT_EQ(problem.regrid.criteria[0].variable, "c.density");
}

TEST(IceScene, LeavesOutWhatUintahAloneComputes) {
  EXPECT_EQ(problemOf(changedScene(sod, "rho_CC", "delP_Dilatate")),
            "'delP_Dilatate' is not saved, since no task computes it in this scene");
}

}  // namespace tushar::ice
