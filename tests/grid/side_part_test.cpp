#include "core/grid/side_part.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/grid/level.hpp"
#include "tests/support/levels.hpp"

// The faces of a side that belong to a part of it are those whose middle is in the part.

namespace tushar::grid {

namespace {

/// A box of [0, 1] m with `cells` cells along each axis and one part on the side x-.
Domain withPart(const SidePart& part, int cells = 8) {
  Domain domain = test::domain({{cells, cells, cells}});
  domain.upper = Vec3::Ones();
  domain.boundaries.parts[0] = {{part, {}}};
  return domain;
}

/// Draws the faces on x-, one line for each z from 0 on: # marks faces of the part.
std::vector<std::string> facesOf(const SidePart& part, int cells = 8) {
  const Level level(withPart(part, cells));
  std::vector<std::string> lines(static_cast<std::size_t>(cells));
  for (int z = 0; z < cells; ++z)
    for (int y = 0; y < cells; ++y)
      lines[static_cast<std::size_t>(z)] += level.partAt<3>(0, 0, Index3{{0, y, z}}) == 0 ? '#' : '.';
  return lines;
}

const Vec3 middle(0, 0.5, 0.5);

}  // namespace

TEST(SidePart, CircleHasTheFacesWhoseMiddleIsWithinItsRadius) {
  EXPECT_EQ(facesOf(SidePart::circle(0, middle, 0.35)),
            (std::vector<std::string>{"........", "...##...", "..####..", ".######.", ".######.", "..####..",
                                      "...##...", "........"}));
}

TEST(SidePart, RimBelongsToIt) {
  // The middles of the four faces around the origin are (1/16, 1/16) away from it.
  const double radius = std::sqrt(2.0) / 16;
  EXPECT_EQ(facesOf(SidePart::circle(0, middle, radius))[3], "...##...");
  EXPECT_EQ(facesOf(SidePart::circle(0, middle, radius * (1 - 1e-6)))[3], "........");
}

TEST(SidePart, AnnulusLeavesItsHoleToACircle) {
  const SidePart hole = SidePart::circle(0, middle, 0.2), ring = SidePart::annulus(0, middle, 0.2, 0.4),
                 all = SidePart::circle(0, middle, 0.4);
  const auto inHole = facesOf(hole), inRing = facesOf(ring), inAll = facesOf(all);
  for (std::size_t z = 0; z < 8; ++z)
    for (std::size_t y = 0; y < 8; ++y)
      EXPECT_EQ(static_cast<int>(inHole[z][y] == '#') + static_cast<int>(inRing[z][y] == '#'),
                static_cast<int>(inAll[z][y] == '#'));
  EXPECT_EQ(inRing[3], ".#....#.");
}

TEST(SidePart, RectangleHasTheFacesBetweenItsCorners) {
  EXPECT_EQ(facesOf(SidePart::rectangle(0, Vec3(0, 0.25, 0), Vec3(0, 0.75, 0.25))),
            (std::vector<std::string>{"..####..", "..####..", "........", "........", "........", "........",
                                      "........", "........"}));
}

TEST(SidePart, RectangulusIsARectangleWithoutASmallerOne) {
  const SidePart frame = SidePart::rectangulus(0, {Vec3(0, 0.375, 0.375), Vec3(0, 0.625, 0.625)},
                                               {Vec3(0, 0.25, 0.25), Vec3(0, 0.75, 0.75)});
  EXPECT_EQ(facesOf(frame), (std::vector<std::string>{"........", "........", "..####..", "..#..#..", "..#..#..",
                                                      "..####..", "........", "........"}));
}

TEST(SidePart, EllipseIsTurnedAsSeenFromOutside) {
  const auto along = [](int axis, int side, double degrees, const Vec3& x) {
    return SidePart::ellipse(axis, side, Vec3::Zero(), 0.1, 1, degrees).holds(x);
  };
  EXPECT_TRUE(along(0, 1, 0, Vec3(0, 0.9, 0)));
  EXPECT_TRUE(along(0, 1, 90, Vec3(0, 0, 0.9)));
  EXPECT_FALSE(along(0, 1, 90, Vec3(0, 0.9, 0)));
  EXPECT_TRUE(along(0, 1, 45, Vec3(0, 0.6, 0.6)));
  EXPECT_TRUE(along(0, 0, 45, Vec3(0, 0.6, -0.6)));
  EXPECT_TRUE(along(1, 1, 0, Vec3(0, 0, 0.9)));
  EXPECT_TRUE(along(1, 1, 45, Vec3(0.6, 0, 0.6)));
  EXPECT_TRUE(along(2, 1, 0, Vec3(0.9, 0, 0)));
  EXPECT_TRUE(along(2, 0, 45, Vec3(0.6, -0.6, 0)));
  EXPECT_FALSE(along(2, 0, 45, Vec3(0.6, 0.6, 0)));
}

TEST(SidePart, OfRoundAxesIsACircle) {
  const auto circle = facesOf(SidePart::circle(0, middle, 0.3));
  EXPECT_EQ(facesOf(SidePart::ellipse(0, 0, middle, 0.3, 0.3, 20)), circle);
}

TEST(PartsOfSides, AreFoundByTheMiddleOfTheFaceOnEachLevel) {
  // The rim lies between the middles of the two finer faces, and beyond that of the coarse one.
  const Domain domain = withPart(SidePart::rectangle(0, Vec3::Zero(), Vec3(0, 0.2, 1)), 4);
  const Level coarse(domain, 0, 2, nullptr), fine(domain, 1, 2, nullptr);
  EXPECT_EQ(coarse.partAt<3>(0, 0, Index3{{0, 0, 0}}), 0);
  EXPECT_EQ(fine.partAt<3>(0, 0, Index3{{0, 0, 0}}), 0);
  EXPECT_EQ(fine.partAt<3>(0, 0, Index3{{0, 1, 0}}), 0);
  EXPECT_EQ(fine.partAt<3>(0, 0, Index3{{0, 2, 0}}), restOfSide);
  EXPECT_EQ(coarse.partAt<3>(0, 0, Index3{{0, 1, 0}}), restOfSide);
}

TEST(PartsOfSides, OfCellsBeyondTheGridAreThoseOfTheNearest) {
  const Level level(withPart(SidePart::rectangle(0, Vec3::Zero(), Vec3(0, 0.125, 1))));
  EXPECT_EQ(level.partAt<3>(0, 0, Index3{{-2, -2, 9}}), 0);
  EXPECT_EQ(level.partAt<3>(0, 1, Index3{{-2, -2, 9}}), restOfSide);
}

TEST(PartsOfSides, HaveConditionsInPlaceOfThoseOfTheSide) {
  constexpr BoundaryLabel<double> heat{"Temperature"}, pressure{"Pressure"};
  Domain domain = withPart(SidePart::circle(0, middle, 0.3));
  domain.boundaries.faces[0] = {{heat, BoundaryKind::dirichlet, Vec3(1, 0, 0)},
                                {pressure, BoundaryKind::dirichlet, Vec3(2, 0, 0)}};
  domain.boundaries.parts[0][0].conditions = {{heat, BoundaryKind::dirichlet, Vec3(3, 0, 0), 1}};
  const Level level(domain);

  EXPECT_EQ(level.boundary(0, 0, heat, 1, 0)->value, 3);
  EXPECT_FALSE(level.boundary(0, 0, pressure, 1, 0));
  EXPECT_EQ(level.boundary(0, 0, heat, 1)->value, 1);
  // The part has no conditions for material 0.
  EXPECT_EQ(level.boundary(0, 0, heat, 0, 0)->value, 1);
  EXPECT_EQ(level.boundary(0, 0, pressure, 0, 0)->value, 2);
  domain.boundaries.parts[0][0].conditions.clear();
  EXPECT_FALSE(Level(domain).boundary(0, 0, heat, 0, 0)) << "a hole in the side";
  const BoundarySides<double> sides = level.sides(heat, 1);
  EXPECT_EQ(sides(0, 0, Index3{{0, 3, 3}})->value, 3);
  EXPECT_EQ(sides(0, 0, Index3{{0, 0, 0}})->value, 1);
}

TEST(PartsOfSides, KeepAnAxisOfOneCellInUse) {
  Domain domain = test::domain({{4, 4, 1}});
  EXPECT_EQ(Level(domain).dimension(), 2);
  domain.boundaries.parts[5] = {{SidePart::circle(2, Vec3(0.5, 0.5, 1), 0.3), {}}};
  EXPECT_EQ(Level(domain).dimension(), 3);
}

}  // namespace tushar::grid
