#include "core/grid/boundary.hpp"

#include <gtest/gtest.h>

#include "core/grid/level.hpp"
#include "tests/support/levels.hpp"

namespace tushar::grid {

namespace {

constexpr BoundaryLabel<double> temperature{"Temperature"};
constexpr BoundaryLabel<Vec3> velocity{"Velocity"};

/// A grid with symmetry planes all around except on x-, where the conditions of the test apply.
Domain withConditions() {
  Domain domain = test::domain({{4, 3, 2}});
  domain.boundaries.face(0, 0) = {{temperature, BoundaryKind::dirichlet, Vec3(300, 0, 0)},
                                  {velocity, BoundaryKind::dirichlet, Vec3(1, 2, 3), 1}};
  return domain;
}

}  // namespace

TEST(Boundary, IsFoundByItsLabelWithAValueOfItsType) {
  const Level level(withConditions());

  const std::optional<BoundaryValue<double>> given = level.boundary(0, 0, temperature);

  ASSERT_TRUE(given);
  EXPECT_TRUE(given->isDirichlet());
  EXPECT_EQ(given->value, 300);
  EXPECT_FALSE(level.boundary(0, 1, temperature));
}

TEST(Boundary, HoldsForTheMaterialThatItNames) {
  const Level level(withConditions());

  EXPECT_FALSE(level.boundary(0, 0, velocity));
  ASSERT_TRUE(level.boundary(0, 0, velocity, 1));
  EXPECT_EQ(level.boundary(0, 0, velocity, 1)->value, Vec3(1, 2, 3));
}

TEST(Boundary, IsLookedUpOnceForAllSides) {
  const Level level(withConditions());

  const BoundarySides<double> sides = level.sides(temperature);

  for (int d = 0; d < 3; ++d)
    for (const int side : {0, 1}) EXPECT_EQ(sides(d, side).has_value(), d == 0 && side == 0);
}

TEST(Boundary, OfAPlaneOfSymmetryIsNoValue) {
  const Level level(withConditions());

  EXPECT_FALSE(level.isSymmetry(0, 0));
  EXPECT_TRUE(level.isSymmetry(0, 1));
}

TEST(Boundary, IsWrittenInTheWordsOfTheScene) {
  EXPECT_EQ(nameOf(BoundaryKind::symmetry), "symmetry");
  EXPECT_EQ(nameOf(BoundaryKind::dirichlet), "Dirichlet");
  EXPECT_EQ(nameOf(BoundaryKind::neumann), "Neumann");
}

}  // namespace tushar::grid
