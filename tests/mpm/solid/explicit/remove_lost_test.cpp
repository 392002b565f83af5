#include <gtest/gtest.h>

#include "components/mpm/solid/explicit/tasks/remove_lost.hpp"
#include "core/data/vanished.hpp"
#include "tests/mpm/solid/explicit/bare_update.hpp"

namespace tushar::mpm::solid {
namespace {

/// Three particles in a cell; the step turns the second inside out.
struct Cell {
  Grid grid{domain()};
  const Level& level = grid.level();
  data::ParticleSet set;
  std::vector<Vec<2>> x{{0.2, 0.2}, {0.5, 0.5}, {0.7, 0.7}}, newX = x, velocity{{1, 0}, {0, 0}, {-2, 0}};
  std::vector<double> mass{1, 1, 1}, oldVolume{1, 2, 3}, volume{4, 5, 6};
  std::vector<Matrix3> before = std::vector<Matrix3>(3, Matrix3::Identity());
  std::vector<Matrix3> deformation{Matrix3::Identity(), Vec3(1, -0.5, 1).asDiagonal(), Matrix3::Identity()};
  std::vector<double> waveSpeed{3, std::nan(""), 5};

  static grid::Domain domain() {
    grid::Domain domain;
    domain.upper = {1, 1, 0};
    domain.resolution = {{1, 1, 0}};
    domain.boundaries.face(0, 0) = {{grid::symmetric, grid::BoundaryKind::symmetry}};
    return domain;
  }

  /// Returns the stable time step of the cell [s].
  double remove(bool canRemove = true) {
    set.reset(grid.patches().front(), 0);
    set.setOwned(3);
    const auto view = [&](auto& values) {
      return ParticleView<typename std::decay_t<decltype(values)>::value_type>{values.data(), set, level.cells()};
    };
    StateUpdate<2> update = bareUpdate(set, level);
    update.x = {x.data(), set, level.cells()};
    update.velocity = {velocity.data(), set, level.cells()};
    update.mass = {mass.data(), set, level.cells()};
    update.oldDeformation = {before.data(), set, level.cells()};
    update.oldVolume = ParticleView<const double>{oldVolume.data(), set, level.cells()};
    update.deformation = view(deformation);
    update.volume = view(volume);
    if (canRemove) update.newX = view(newX);
    const CrossingRate<2> none(level);
    const BetweenPlanes<2> space(level, 0);
    return withoutLost<2>(level, update, Index<2>{}, {0, 3}, none, space, waveSpeed.data()).time();
  }
};

TEST(RemoveLost, RemovesTheParticleAndGivesItTheStateAtTheStartOfTheStep) {
  Cell cell;

  cell.remove();

  EXPECT_EQ(cell.newX[1][0], data::removed);
  EXPECT_EQ(cell.deformation[1], cell.before[1]);
  EXPECT_EQ(cell.volume, (std::vector<double>{4, 2, 6}));
  EXPECT_EQ(cell.newX[0], cell.x[0]);
  EXPECT_EQ(cell.newX[2], cell.x[2]);
}

TEST(RemoveLost, LeavesTheTimeStepToTheOtherParticles) {
  Cell cell;

  EXPECT_EQ(cell.remove(), 1.0 / 7);  // 5 m/s + 2 m/s through 1 m
}

TEST(RemoveLost, StopsTheRunWhereParticlesCannotBeRemoved) {
  Cell cell;

  EXPECT_THROW(cell.remove(false), NumericalError);
  EXPECT_EQ(cell.newX[1], cell.x[1]);
}

TEST(RemoveLost, NamesAParticleThatTheStepDeformsTooMuch) {
  Cell cell;
  cell.deformation[1] = -Matrix3::Identity();
  try {
    cell.remove(false);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("the step deforms the particle at (0.5, 0.5, 0) m so much"),
              std::string::npos)
        << error.what();
  }
  cell.remove();
  EXPECT_EQ(cell.newX[1][0], data::removed);
}

TEST(RemoveLost, StopsTheRunIfAParticleIsSoundButItsWaveHasNoSpeed) {
  Cell cell;
  cell.deformation[1] = Matrix3::Identity();

  EXPECT_THROW(cell.remove(), NumericalError);
}

TEST(RemoveLost, LeavesWhatIsNotANumberToThoseWhoReportIt) {
  Cell cell;
  cell.deformation[1] = Matrix3::Identity();
  cell.waveSpeed[1] = 3;
  cell.newX[0][0] = std::nan("");
  cell.newX[2][0] = -0.2;
  cell.remove();
  EXPECT_TRUE(std::isnan(cell.newX[0][0]));
  EXPECT_EQ(cell.newX[2][0], data::removed);

  Cell broken;
  broken.deformation[1](0, 0) = std::nan("");
  EXPECT_THROW(broken.remove(), NumericalError);
}

TEST(RemoveLost, RemovesWhatIsThrownThroughASymmetryPlaneButNotWhatLeavesThroughAFreeSide) {
  Cell cell;
  cell.deformation[1] = Matrix3::Identity();
  cell.waveSpeed[1] = 3;
  cell.newX[0][0] = -0.11;
  cell.newX[2][0] = 1.5;

  cell.remove();

  EXPECT_EQ(cell.newX[0][0], data::removed);
  EXPECT_EQ(cell.newX[1], cell.x[1]);
  EXPECT_EQ(cell.newX[2][0], 1.5);
}

TEST(RemoveLost, PutsBackWhatDriftsThroughASymmetryPlane) {
  Cell cell;
  cell.newX[0] = {-0.0625, 0.25};

  EXPECT_EQ(cell.remove(), 1.0 / 7);

  EXPECT_EQ(cell.newX[0], Vec<2>(0.0625, 0.25));
  EXPECT_EQ(cell.deformation[0], Matrix3::Identity());
  EXPECT_EQ(cell.newX[1][0], data::removed) << "it is inverted";
}

}  // namespace
}  // namespace tushar::mpm::solid
