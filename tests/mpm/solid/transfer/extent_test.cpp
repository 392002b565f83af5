#include "components/mpm/solid/transfer/extent.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace tushar::mpm::solid {
namespace {

/// Half the edges of a box with the given half edges, turned by an angle in the plane of the first two axes.
template <int D>
Eigen::Matrix<double, D, D> turned(const Vec<D>& halfEdges, double angle) {
  Eigen::Matrix<double, D, D> turn = Eigen::Matrix<double, D, D>::Identity();
  turn.template topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return turn * halfEdges.asDiagonal();
}

TEST(ShortenDiagonals, LeavesShortOnesUnchanged) {
  const Eigen::Matrix2d before = turned<2>({.5, .3}, .4);
  Eigen::Matrix2d edges = before;
  shortenDiagonals<2>(edges, .25, .9);
  EXPECT_EQ(edges, before);
}

TEST(ShortenDiagonals, ShrinksABoxAsAWhole) {
  // All diagonals of a box have one length, so that it is shrunk along all of its edges.
  const Eigen::Matrix2d plane = turned<2>({1.2, .2}, .7);
  Eigen::Matrix2d edges = plane;
  shortenDiagonals<2>(edges, .25, .9);
  const double factor = .9 / std::sqrt(1.2 * 1.2 + .2 * .2 + .25);
  EXPECT_LT((edges - factor * plane).norm(), 1e-15);

  const Eigen::Matrix3d space = turned<3>({1.2, .2, .5}, .7);
  Eigen::Matrix3d same = space;
  shortenDiagonals<3>(same, 0, .9);
  EXPECT_LT((same - factor * space).norm(), 1e-15);
  EXPECT_LT((same.topLeftCorner<2, 2>() - edges).norm(), 1e-15) << "the axis that a grid does not use counts alike";
}

TEST(ShortenDiagonals, ShortensOnlyTheLongDiagonalOfASkewedBox) {
  Eigen::Matrix2d edges;
  edges << .5, .4, 0, .2;  // diagonals (.9, .2) and (.1, -.2)
  shortenDiagonals<2>(edges, 0, .5);
  EXPECT_NEAR((edges.col(0) + edges.col(1)).norm(), .5, 1e-15);
  EXPECT_LT((edges.col(0) - edges.col(1) - Vec<2>(.1, -.2)).norm(), 1e-15);
}

TEST(ShortenDiagonals, CountsAxesThatTheGridDoesNotUse) {
  Eigen::Matrix<double, 1, 1> edge;
  edge << .8;
  shortenDiagonals<1>(edge, .25 + .25, .9);
  EXPECT_NEAR(edge(0), .8 * .9 / std::sqrt(.8 * .8 + .5), 1e-15);
}

}  // namespace
}  // namespace tushar::mpm::solid
