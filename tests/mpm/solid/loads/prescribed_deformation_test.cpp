#include "components/mpm/solid/loads/prescribed_deformation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "components/mpm/solid/explicit/tasks/deform_particles.hpp"
#include "tests/support/temporary.hpp"

// A prescribed deformation of a body: its rate, and the files that describe it.

namespace tushar::mpm::solid {
namespace {

using Point = PrescribedDeformation::Point;

Matrix3 turnedAboutZ(double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// A deformation that stretches and shears, with a rotation about z, then about x.
PrescribedDeformation path() {
  Matrix3 sheared = Matrix3::Identity(), pressed = 0.9 * Matrix3::Identity();
  sheared(0, 1) = 0.3;
  pressed(2, 0) = -0.2;
  return PrescribedDeformation(
      {{0, Matrix3::Identity(), 0, Vec3::UnitX()}, {1, sheared, 90, Vec3::UnitZ()}, {3, pressed, 40, Vec3::UnitX()}});
}

TEST(PrescribedDeformation, GoesStraightBetweenPointsAndTurnsFromEach) {
  const PrescribedDeformation p = path();
  EXPECT_TRUE(p.deformation(0).isApprox(Matrix3::Identity()));
  Matrix3 half = Matrix3::Identity();
  half(0, 1) = 0.15;
  EXPECT_TRUE(p.deformation(0.5).isApprox(turnedAboutZ(45) * half));
  EXPECT_TRUE(p.deformation(1).isApprox(p.deformation(1 + 1e-12), 1e-9)) << "without a jump";
  const Matrix3 end = 0.9 * Matrix3::Identity() + Matrix3{{0, 0, 0}, {0, 0, 0}, {-0.2, 0, 0}};
  const Matrix3 aboutX = Eigen::AngleAxisd(40 * std::numbers::pi / 180, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_TRUE(p.deformation(3).isApprox(aboutX * turnedAboutZ(90) * end));
}

/// L = dF/dt F^-1 by central differences, also beyond the last point.
TEST(PrescribedDeformation, HasTheGradientOfItsVelocity) {
  const PrescribedDeformation p = path();
  for (const double time : {0.2, 0.9, 1.5, 2.9, 3.4}) {
    const double h = 1e-5;
    const Matrix3 rate = (p.deformation(time + h) - p.deformation(time - h)) / (2 * h);
    EXPECT_LT((p.velocityGradient(time) - rate * p.deformation(time).inverse()).norm(), 1e-8) << time;
  }
}

/// The times of steps are sums of many numbers: round-off must not choose between two parts of the path.
TEST(PrescribedDeformation, FollowsTheNextPartFromEachPointOn) {
  const PrescribedDeformation p = path();
  const Matrix3 after = p.velocityGradient(1 + 1e-6);
  EXPECT_GT((after - p.velocityGradient(1 - 1e-6)).norm(), 0.1);
  for (const double time : {1 - 1e-13, 1.0, 1 + 1e-13})
    EXPECT_LT((p.velocityGradient(time) - after).norm(), 1e-5) << time - 1;
}

TEST(Deform, FollowsTheSeriesOfTheExponential) {
  Matrix3 gradient, result;
  gradient << 0, -2, 0, 2, 0, 0, 0, 0, 0.5;
  const Matrix3 f = 1.5 * Matrix3::Identity(), step = 0.1 * gradient;
  deformBySeries(f, gradient, 0.1, 0, result);
  EXPECT_EQ(result, f) << "as in Uintah, the power 0 alone";
  deformBySeries(f, gradient, 0.1, 2, result);
  EXPECT_TRUE(result.isApprox((Matrix3::Identity() + step + 0.5 * step * step) * f));
  deformBySeries(f, gradient, 0.1, 12, result);
  EXPECT_TRUE(
      result.topLeftCorner(2, 2).isApprox(1.5 * turnedAboutZ(0.2 * 180 / std::numbers::pi).topLeftCorner(2, 2)));
  EXPECT_NEAR(result(2, 2), 1.5 * std::exp(0.05), 1e-12);
}

struct File {
  std::string path = test::temporaryFolder() + "prescribed_deformation.inp";
  explicit File(const std::string& text) { std::ofstream(path) << text; }
  ~File() { std::filesystem::remove(path); }
};

/// Returns the messages about a file, each with its line.
std::vector<std::string> problemsOf(const std::string& text) {
  const File file(text);
  input::Diagnostics diagnostics;
  readPrescribedDeformation(file.path, {"scene.ups", 3, 1}, diagnostics);
  std::vector<std::string> found;
  for (const InputProblem& problem : diagnostics.sorted())
    found.push_back(std::to_string(problem.where.line) + ": " + problem.sentence);
  return found;
}

const std::string start = "0 1 0 0 0 1 0 0 0 1 0 0 0 0\n";

TEST(PrescribedDeformation, IsReadFromPointsOf14Numbers) {
  const File file(start + "\n2. .5 0 0  0 1. 0\n 0 0 1e0  180 0 0 2\n");
  input::Diagnostics diagnostics;
  const auto read = readPrescribedDeformation(file.path, {}, diagnostics);
  ASSERT_TRUE(read);
  Matrix3 pressed = Matrix3::Identity();
  pressed(0, 0) = 0.75;
  EXPECT_TRUE(read->deformation(1).isApprox(turnedAboutZ(90) * pressed)) << "the axis has any length";
}

TEST(PrescribedDeformation, SaysWhatIsWrongWithAFileAndWhere) {
  using Sentences = std::vector<std::string>;
  EXPECT_EQ(problemsOf(start + "1 1 0 0 0 x 0 0 0 1 0 0 0 0\n")[0], "2: found 'x', expected a number");
  EXPECT_EQ(problemsOf(start + start), Sentences{"2: its time is not after that of the previous point"});
  EXPECT_EQ(problemsOf(start + "1 -1 0 0 0 1 0 0 0 1 0 0 0 0\n"), Sentences{"2: det F is -1, expected more than 0"});
  EXPECT_EQ(problemsOf(start + "1 1 0 0 0 1 0 0 0 1 9 0 0 0\n"),
            Sentences{"2: a rotation needs an axis: its three components are 0"});
  EXPECT_EQ(problemsOf(start + "1 1 0\n")[0].substr(0, 41), "2: found 3 numbers, expected 14 per point");
  EXPECT_NE(problemsOf(start)[0].find("has 1 points in time, expected at least 2"), std::string::npos);
}

}  // namespace
}  // namespace tushar::mpm::solid
