#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/scenes.hpp"

// The references as modules of scenes: measured errors decrease with the cell width, and refusals have messages.

namespace tushar::reference {

namespace {

using Overrides = std::vector<std::string>;

double cellError(const report::Report& report, const std::string& field) {
  for (const report::ErrorNorms& error : report.errors)
    if (error.field == field && error.place == "cell") return error.norms.at("L1");
  throw std::logic_error("the report has no cell error of " + field);
}

/// Returns the order of the L1 error of a field's cell means between two runs, the second on the finer grid.
double orderOf(const std::string& field, const report::Report& coarse, const report::Report& fine) {
  return std::log(cellError(coarse, field) / cellError(fine, field)) / std::log(coarse.spacing / fine.spacing);
}

std::string cells(int x, int y = 1, int z = 1) {
  return "Grid/Level/Box/resolution=[" + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + "]";
}

/// Returns the error message for a scene, without its place.
std::string problemOf(const std::string& scene, const Overrides& overrides) {
  try {
    scene::readScene(scene, overrides, catalogue());
  } catch (const InputError& error) {
    return error.problems().size() == 1 ? error.problems()[0].sentence : std::string(error.what());
  }
  return "nothing";
}

}  // namespace

TEST(VortexScene, IsOfSecondOrder) {
  const std::string end = "Time/maxTime=1";
  const auto coarse = test::runScene("ups/euler/vortex.ups", {cells(48, 48), end});
  const auto fine = test::runScene("ups/euler/vortex.ups", {cells(96, 96), end});
  EXPECT_GT(orderOf("density", coarse, fine), 1.9);
  EXPECT_GT(orderOf("velocity", coarse, fine), 1.9);
  EXPECT_GT(orderOf("pressure", coarse, fine), 1.9);
  EXPECT_GT(orderOf("energy", coarse, fine), 1.9);
}

TEST(VortexScene, ComesBackAfterAPeriod) {
  // L1 of the density is 3.3e-3, but .035 against a vortex half a period away.
  EXPECT_LT(cellError(test::runScene("ups/euler/vortex.ups", {cells(48, 48)}), "density"), 4e-3);
}

TEST(VortexScene, MeasuresTheSameInThreeDimensions) {
  const std::string steps = "Time/delt_max=0.05", end = "Time/maxTime=1";  // steps below what either would take
  const auto plane = test::runScene("ups/euler/vortex.ups", {cells(16, 16), steps, end});
  const auto space = test::runScene("ups/euler/vortex.ups", {cells(16, 16, 2), steps, end});
  EXPECT_EQ(plane.steps, space.steps);
  EXPECT_NEAR(cellError(space, "density") / cellError(plane, "density"), 1, 1e-12);
}

TEST(VortexScene, NeedsThePlaneInWhichItTurns) {
  EXPECT_EQ(problemOf("ups/euler/vortex.ups", {"DataAnalysis/Module/axis=x"}),
            "axis: a vortex around x needs a grid in y and z, but this grid does not use z");
}

TEST(VortexScene, RefusesAnEmptyMiddle) {
  EXPECT_EQ(problemOf("ups/euler/vortex.ups", {"DataAnalysis/Module/strength=12"}),
            "A vortex of strength 12 m/s leaves no gas at its centre; the strength must be below 10.0828 m/s.");
}

TEST(GreshoScene, HasErrorsThatFall) {
  const auto coarse = test::runScene("ups/euler/gresho.ups", {cells(32, 32), "Time/maxTime=0.5"});
  const auto fine = test::runScene("ups/euler/gresho.ups", {cells(64, 64), "Time/maxTime=0.5"});
  EXPECT_GT(orderOf("velocity", coarse, fine), 1);
  EXPECT_GT(orderOf("pressure", coarse, fine), 1);
}

TEST(GreshoScene, NeedsRoomForTheVortex) {
  EXPECT_EQ(problemOf("ups/euler/gresho.ups", {"DataAnalysis/Module/radius=0.3"}),
            "A Gresho vortex of radius 0.3 m is 1.2 m wide and does not fit into a period of 1 m.");
}

TEST(NohScene, HasErrorsThatFallInOneTwoAndThreeDimensions) {
  const std::string line = "Grid/Level/Box/upper=[1,0,0]";
  const std::string falling =
      "Euler/geom_object/velocity=[-x/sqrt(x^2+y^2+z^2),-y/sqrt(x^2+y^2+z^2),-z/sqrt(x^2+y^2+z^2)]";
  const auto order = [](const Overrides& coarse, const Overrides& fine) {
    return orderOf("density", test::runScene("ups/euler/noh.ups", coarse), test::runScene("ups/euler/noh.ups", fine));
  };
  EXPECT_GT(order({cells(50), line}, {cells(100), line}), 0.8);
  EXPECT_GT(order({cells(50, 50)}, {cells(100, 100)}), 0.6);
  const std::string cube = "DataAnalysis/Module/within/max=[0.35,0.35,0.35]";
  EXPECT_GT(order({cells(16, 16, 16), falling, cube}, {cells(32, 32, 32), falling, cube}), 0.4);  // from 32 to 64: .96
}

TEST(NohScene, MeasuresWithinItsRegionAlone) {
  const auto inside = test::runScene("ups/euler/noh.ups", {cells(40, 40)});
  const auto farther = test::runScene("ups/euler/noh.ups", {cells(40, 40), "DataAnalysis/Module/within/max=[1,1,1]"});
  EXPECT_EQ(inside.fingerprint, farther.fingerprint);
  EXPECT_NE(cellError(inside, "density"), cellError(farther, "density"));
}

TEST(NohScene, RefusesARegionUpsideDown) {
  EXPECT_EQ(problemOf("ups/euler/noh.ups", {"DataAnalysis/Module/within/max=[-1,1,1]"}),
            "max is below min along x: -1 < 0 m");
}

/// Runs the blast in d dimensions on n cells of 1.2 / n m per axis, with all energy (1 J, J/m or J/m²) in the first.
report::Report blast(int d, int n) {
  const auto corner = [d](double along, double across) {
    return fmt::format("[{},{},{}]", along, d > 1 ? along : across, d > 2 ? along : across);
  };
  const double h = 1.2 / n;
  return test::runScene(
      "ups/euler/sedov.ups",
      {cells(n, d > 1 ? n : 1, d > 2 ? n : 1), "Time/maxTime=0.8", "Grid/Level/Box/upper=" + corner(1.2, 0),
       "Euler/geom_object[1]/box/max=[1.2,1.2,1.2]", "Euler/geom_object[2]/box/max=" + corner(h, 1.2),
       fmt::format("Euler/geom_object[2]/pressure={}", 0.4 / std::pow(2 * h, d)), "DataAnalysis/Module/energy=1"});
}

TEST(SedovScene, HasErrorsThatFallInOneTwoAndThreeDimensions) {
  // Few cells across the shell behind the shock, so the order is low.
  const int coarse[] = {60, 40, 12}, fine[] = {120, 80, 20};
  for (int d = 1; d <= 3; ++d) {
    const auto wide = blast(d, coarse[d - 1]), narrow = blast(d, fine[d - 1]);
    EXPECT_GT(orderOf("density", wide, narrow), 0.25) << d;
    EXPECT_GT(orderOf("velocity", wide, narrow), 0.25) << d;
    EXPECT_GT(orderOf("pressure", wide, narrow), 0.25) << d;
  }
}

TEST(SedovScene, RefusesAGasThatLeavesAVoid) {
  const std::string space = "Grid/Level/Box/resolution=[4,4,4]";
  EXPECT_EQ(problemOf("ups/euler/sedov.ups", {space, "DataAnalysis/Module/gamma=8"}),
            "A blast in three dimensions leaves a void at its centre if gamma is 7 or more, but gamma is 8.");
}

TEST(DiagonalTubeScene, HasErrorsThatFall) {
  const auto coarse = test::runScene("ups/euler/sod_diagonal.ups", {cells(50, 50)});
  const auto fine = test::runScene("ups/euler/sod_diagonal.ups", {cells(100, 100)});
  EXPECT_GT(orderOf("density", coarse, fine), 0.7);
  EXPECT_GT(orderOf("velocity", coarse, fine), 0.7);
  EXPECT_GT(orderOf("pressure", coarse, fine), 0.7);
}

TEST(DiagonalTubeScene, RefusesWhatTheGridCannotHold) {
  const std::string scene = "ups/euler/sod_diagonal.ups", normal = "DataAnalysis/Module/normal=";
  EXPECT_EQ(problemOf(scene, {normal + "[1,1,1]"}), "normal: points along z, but this grid does not use z");
  EXPECT_EQ(problemOf(scene, {normal + "[1,1.1,0]"}),
            "normal: in this direction the grid has a period of 1.34535 m for one axis, but 1.47988 m for another");
  EXPECT_EQ(problemOf(scene, {normal + "[0,0,0]"}), "normal is [0,0,0], which is not a direction");
  EXPECT_EQ(problemOf(scene, {"DataAnalysis/Module/diaphragm=1"}),
            "The diaphragm must lie between two mirrors, which are 0.707107 m apart along the tube, but it is 0.707107 "
            "m from the first.");
}

TEST(DiagonalTubeScene, LeavesErrorsOutOnceItsWavesHaveMet) {
  const auto report = test::runScene("ups/euler/sod_diagonal.ups", {cells(20, 20), "Time/maxTime=0.25"});
  EXPECT_TRUE(report.errors.empty());
  EXPECT_EQ(report.unmeasured, std::vector<std::string>{"'exactRiemann' has no solution at t = 0.25 s"});
}

}  // namespace tushar::reference
