#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace tushar::euler {

namespace {

using Overrides = std::vector<std::string>;

double densityError(Overrides overrides, int cells) {
  overrides.push_back("Grid/Level/Box/resolution=[" + std::to_string(cells) + ",1,1]");
  for (const report::ErrorNorms& error : test::runScene("ups/euler/sod.ups", overrides).errors)
    if (error.field == "density" && error.place == "cell") return error.norms.at("L1");
  return -1;
}

/// Returns Sod's scene with a piece of text replaced.
std::string changedScene(const std::string& from, const std::string& to) {
  return test::changedScene("ups/euler/sod.ups", from, to);
}

/// Returns the error message for a scene, without its place.
std::string problemOf(const std::string& scene) {
  try {
    test::runScene(scene, {});
  } catch (const InputError& error) {
    return error.problems().size() == 1 ? error.problems()[0].sentence : std::string(error.what());
  }
  return "nothing";
}

}  // namespace

TEST(SodsTube, HasTheErrorsOfTheTable) {
  struct Row {
    Overrides method;
    double coarse, fine;
  };
  // L1 of the density at h = .01 and .005: NUMERICS, section 2, whose first order ran with cfl 0.9.
  const std::vector<Row> table{{{"Euler/reconstruction=first_order", "Euler/cfl=0.9"}, 0.0139, 0.0092},
                               {{"Euler/limiter=minmod"}, 0.00545, 0.00325},
                               {{"Euler/limiter=van_leer"}, 0.00406, 0.00236},
                               {{"Euler/limiter=mc"}, 0.00376, 0.00217}};
  for (const Row& row : table) {
    EXPECT_NEAR(densityError(row.method, 100) / row.coarse, 1, 0.03) << row.method[0];
    EXPECT_NEAR(densityError(row.method, 200) / row.fine, 1, 0.03) << row.method[0];
  }
}

TEST(SodsTube, IsBetterWithTheExactFlux) { EXPECT_LT(densityError({"Euler/flux=exact"}, 100), densityError({}, 100)); }

TEST(SodsTube, HasOneFingerprintOnAnyPatches) {
  const std::string whole = test::runScene("ups/euler/sod.ups", {}).fingerprint;
  for (const char* patches : {"2", "7", "64"})
    EXPECT_EQ(
        test::runScene("ups/euler/sod.ups", {"Grid/Level/Box/patches=[" + std::string(patches) + ",1,1]"}).fingerprint,
        whole);
}

TEST(LaxAndLiu, HasOneFingerprintOnAnyPatches) {
  const std::string small = "Grid/Level/Box/resolution=[40,40,1]";
  const std::string whole = test::runScene("ups/euler/lax_liu_3.ups", {small}).fingerprint;
  for (const char* patches : {"[2,1,1]", "[3,5,1]", "[40,1,1]", "[8,8,1]"})
    EXPECT_EQ(test::runScene("ups/euler/lax_liu_3.ups", {small, "Grid/Level/Box/patches=" + std::string(patches)})
                  .fingerprint,
              whole);
}

TEST(Sedov, KeepsMassAndEnergy) {
  for (const report::Drift& drift :
       test::runScene("ups/euler/sedov.ups", {"Grid/Level/Box/resolution=[60,60,1]"}).drifts)
    EXPECT_NEAR(drift.name == "momentum" ? 0 : drift.change, 0, 1e-12) << drift.name;
}

TEST(EulerScene, MeasuresCellsAlone) {
  for (const report::ErrorNorms& error : test::runScene("ups/euler/sod.ups", {}).errors) EXPECT_EQ(error.place, "cell");
}

TEST(EulerScene, NamesACellThatNoObjectContains) {
  EXPECT_EQ(problemOf(changedScene("<max>[0.5,1,1]</max>", "<max>[0.4,1,1]</max>")),
            "no geom_object contains the centre of the cell at (0.405, 0.5, 0.5); every cell needs a gas at the start");
}

TEST(EulerScene, LetsALaterObjectCountWhereTwoOverlap) {
  const std::string wide = changedScene("<max>[0.5,1,1]</max>", "<max>[1,1,1]</max>");
  EXPECT_EQ(test::runScene(wide, {}).fingerprint, test::runScene("ups/euler/sod.ups", {}).fingerprint);
}

TEST(EulerScene, NamesAFormulaWhoseDensityIsNotPositive) {
  EXPECT_EQ(problemOf(changedScene("<density>1</density>", "<density>x-0.005</density>")),
            "density 0 kg/m^3, pressure 1 Pa and velocity (0, 0, 0) m/s at (0.005, 0.5, 0.5); expected a positive "
            "density and pressure + p_infinity, and finite values");
}

TEST(EulerScene, RefusesStiffnessOfAnIdealGas) {
  EXPECT_EQ(problemOf(changedScene("<gamma>1.4</gamma>", "<gamma>1.4</gamma><p_infinity>1</p_infinity>")),
            "an ideal_gas has no p_infinity; use type=\"stiffened_gas\"");
}

TEST(EulerScene, TakesAStiffenedGas) {
  const std::string scene =
      changedScene("<gas type=\"ideal_gas\"><gamma>1.4</gamma></gas>",
                   "<gas type=\"stiffened_gas\"><gamma>1.4</gamma><p_infinity>0</p_infinity></gas>");
  EXPECT_EQ(test::runScene(scene, {}).fingerprint, test::runScene("ups/euler/sod.ups", {}).fingerprint);
}

TEST(EulerScene, RefusesAFluxAtAFace) {
  EXPECT_EQ(problemOf(changedScene("<BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/>",
                                   "<BCType label=\"Density\" var=\"Neumann\"><value>1</value></BCType>")),
            "var: found 'Neumann', expected 'Dirichlet' for Density of inflowing gas; at a face without conditions, "
            "gas flows out");
}

TEST(EulerScene, RefusesAnInflowOfNoPressure) {
  EXPECT_EQ(problemOf(changedScene("<BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/>",
                                   "<BCType label=\"Pressure\" var=\"Dirichlet\"><value>-1</value></BCType>")),
            "value: found '-1', expected a value greater than 0 Pa");
}

TEST(EulerScene, RefusesAnInflowOfNoDensity) {
  EXPECT_EQ(problemOf(changedScene("<BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/>",
                                   "<BCType label=\"Density\" var=\"Dirichlet\"><value>0</value></BCType>")),
            "value: found '0', expected a value greater than 0 kg/m^3");
}

}  // namespace tushar::euler
