#include "components/mpm/solid/transfer/mirror_images.hpp"

#include <gtest/gtest.h>

#include "core/grid/grid.hpp"

namespace tushar::mpm::solid {
namespace {

/// A grid of 8 x 6 cells with symmetry planes at its sides x- and y+ only.
grid::Domain corner() {
  grid::Domain domain;
  domain.resolution = {{8, 6, 0}};
  domain.upper = {8, 6, 0};
  domain.nodesBeyond = 1;
  domain.boundaries.face(0, 0) = domain.boundaries.face(1, 1) = {{grid::symmetric, grid::BoundaryKind::symmetry}};
  return domain;
}

Material mirrored() {
  Material material;
  material.hasMirrorImages = true;
  return material;
}

TEST(SymmetryPlanes, MirrorNodesBeyondOneOrTwoOfThem) {
  const grid::Grid grid(corner());
  const SymmetryPlanes<2> planes(grid.level(), mirrored());
  const auto imageOf = [&](int i, int j) {
    std::vector<double> found;
    planes.ifBeyond({{i, j}}, [&](const Index<2>& image, const Vec<2>& signs) {
      found = {static_cast<double>(image[0]), static_cast<double>(image[1]), signs[0], signs[1]};
    });
    return found;
  };
  EXPECT_EQ(imageOf(-1, 3), (std::vector<double>{1, 3, -1, 1}));
  EXPECT_EQ(imageOf(4, 7), (std::vector<double>{4, 5, 1, -1}));
  EXPECT_EQ(imageOf(-1, 7), (std::vector<double>{1, 5, -1, -1}));
  EXPECT_EQ(imageOf(-1, -1), (std::vector<double>{1, -1, -1, 1})) << "y- is free";
  for (const auto& [i, j] : {std::pair{0, 3}, {4, 6}, {9, 3}, {4, -1}}) EXPECT_TRUE(imageOf(i, j).empty());
}

TEST(SymmetryPlanes, AreNearTheCellsBesideThem) {
  const grid::Grid grid(corner());
  const SymmetryPlanes<2> planes(grid.level(), mirrored());
  EXPECT_TRUE(planes.mayBeNear({{0, 2}}, 1));
  EXPECT_TRUE(planes.mayBeNear({{4, 5}}, 1));
  EXPECT_FALSE(planes.mayBeNear({{1, 0}}, 1));
  EXPECT_FALSE(planes.mayBeNear({{7, 0}}, 1));
  EXPECT_TRUE(planes.mayBeTouched({.2, 3}, {1.25, 1.25}));
  EXPECT_FALSE(planes.mayBeTouched({.26, 3}, {1.25, 1.25}));
  EXPECT_TRUE(planes.mayBeTouched({4, 5.8}, {1.25, 1.25}));
}

TEST(SymmetryPlanes, ConcernOnlyMaterialsWithImages) {
  const grid::Grid grid(corner());
  EXPECT_TRUE(SymmetryPlanes<2>(grid.level(), mirrored()).any());
  EXPECT_FALSE(SymmetryPlanes<2>(grid.level(), Material()).any());
}

}  // namespace
}  // namespace tushar::mpm::solid
