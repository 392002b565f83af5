#include <gtest/gtest.h>

#include "components/mpm/solid/explicit/tasks/share_volume.hpp"
#include "tests/mpm/solid/explicit/bare_update.hpp"

namespace tushar::mpm::solid {
namespace {

constexpr double roundOff = 1e-14;  // of a dozen operations on numbers of order 1

/// Four particles in a cell, with different masses and deformations.
struct Cell {
  Grid grid{domain()};
  const Level& level = grid.level();
  data::ParticleSet set;
  std::vector<double> mass{1, 2, 3, 4}, volume = std::vector<double>(4);
  std::vector<Matrix3> deformation{diagonal(1.1, 1, 1), diagonal(0.8, 1, 1), diagonal(1, 1.3, 1.2),
                                   diagonal(1, 1, 0.7)};
  std::vector<Matrix3> before = deformation, gradient = std::vector<Matrix3>(4, Matrix3::Zero());
  std::vector<int> localized = std::vector<int>(4, 0);
  double dt = 0.1;

  static grid::Domain domain() {
    grid::Domain domain;
    domain.upper = {1, 1, 0};
    domain.resolution = {{1, 1, 0}};
    return domain;
  }
  static Matrix3 diagonal(double a, double b, double c) { return Vec3(a, b, c).asDiagonal().toDenseMatrix(); }

  void share() {
    set.reset(grid.patches().front(), 0);
    set.setOwned(4);
    for (std::size_t p = 0; p < 4; ++p) volume[p] = mass[p] * before[p].determinant();
    StateUpdate<2> update = bareUpdate(set, level);
    update.mass = {mass.data(), set, level.cells()};
    update.oldDeformation = {before.data(), set, level.cells()};
    update.localized = ParticleView<const int>{localized.data(), set, level.cells()};
    update.deformation = {deformation.data(), set, level.cells()};
    update.volume = ParticleView<double>{volume.data(), set, level.cells()};
    shareVolume<2>(dt, {0, 4}, update, gradient.data());
  }
};

TEST(ShareVolume, GivesTheParticlesOfACellOneChangeOfVolumeAndKeepsThatOfAll) {
  Cell cell;

  cell.share();

  // (1 1.1 + 2 .8 + 3 1.56 + 4 .7) / 10
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_NEAR(cell.deformation[p].determinant(), 1.018, roundOff);
    EXPECT_NEAR(cell.volume[p], 1.018 * cell.mass[p], 10 * roundOff);
  }
}

TEST(ShareVolume, LeavesShapesAsTheyAreAndTellsRatesOfTheChange) {
  Cell cell;

  cell.share();

  for (std::size_t p = 0; p < 4; ++p) {
    const Matrix3 change = cell.deformation[p] * cell.before[p].inverse();
    EXPECT_TRUE(change.isApprox(change(0, 0) * Matrix3::Identity(), roundOff));
    EXPECT_NEAR(cell.gradient[p].trace(), std::log(change.determinant()) / cell.dt, 10 * roundOff);
    EXPECT_NEAR(deviator(cell.gradient[p]).norm(), 0, 10 * roundOff);
  }
}

TEST(ShareVolume, LeavesOutParticlesThatHaveFailedOrAreTurnedInsideOut) {
  Cell cell;
  cell.localized[2] = 1;
  cell.deformation[3] = cell.before[3] = Cell::diagonal(1, 1, -0.01);

  cell.share();

  EXPECT_EQ(cell.deformation[2], cell.before[2]);
  EXPECT_EQ(cell.deformation[3], cell.before[3]);
  for (std::size_t p = 0; p < 2; ++p)
    EXPECT_NEAR(cell.deformation[p].determinant(), 0.9, roundOff);  // (1.1 + 2 x .8) / 3
}

}  // namespace
}  // namespace tushar::mpm::solid
