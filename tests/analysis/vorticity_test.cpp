#include "components/analysis/vorticity.hpp"

#include <gtest/gtest.h>

namespace tushar::analysis {
namespace {

/// Checks the vorticity of a velocity that is linear in space: the same in every cell, also at the sides.
template <int D>
void expectCurl(const grid::Domain& domain, const Eigen::Matrix3d& slope, const Vec3& curl) {
  const Level level(domain);
  ASSERT_EQ(level.dimension(), D);
  const Patch patch(level, 0, level.cells());
  std::vector<Vec<D>> velocities(level.cells().size());
  std::vector<Vec3> found(level.cells().size());
  const CellView<Vec<D>> velocity(velocities.data(), level.cells());
  const CellView<Vec3> vorticity(found.data(), level.cells());
  forEach<D>(level.cells(), [&](const Index<D>& cell) {
    velocity[cell] = level.reduce<D>(slope * level.expandPoint<D>(level.cellCentre<D>(cell)));
  });
  computeVorticity<D>(patch, CellView<const Vec<D>>(velocities.data(), level.cells()), vorticity);
  forEach<D>(level.cells(), [&](const Index<D>& cell) {
    EXPECT_LT((vorticity[cell] - curl).norm(), 1e-13) << vorticity[cell].transpose();  // round-off of differences
  });
}

TEST(Vorticity, OfALinearVelocityIsExactInEveryCell) {
  grid::Domain domain;
  domain.upper = {1, 2, .5};
  domain.resolution = {{4, 5, 3}};
  Eigen::Matrix3d slope;
  slope << 1, 2, 3, -4, 5, .5, 7, -8, 2;
  expectCurl<3>(domain, slope, {-8 - .5, 3 - 7, -4 - 2});
}

TEST(Vorticity, InTwoAxesIsAcrossThem) {
  grid::Domain domain;
  domain.upper = {1, 0, 1};
  domain.resolution = {{4, 1, 3}};
  Eigen::Matrix3d slope;
  slope << 1, 0, 3, 0, 0, 0, 7, 0, 2;
  expectCurl<2>(domain, slope, {0, 3 - 7, 0});
}

}  // namespace
}  // namespace tushar::analysis
