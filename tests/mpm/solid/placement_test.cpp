#include "components/mpm/solid/placement.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <numbers>

#include "components/mpm/solid/material.hpp"
#include "core/input/geometry/shapes.hpp"
#include "core/input/geometry/smooth_cylinder.hpp"
#include "tests/support/levels.hpp"

// Bodies whose particles start elsewhere than in equal parts of cells.

namespace tushar::mpm::solid {
namespace {

grid::Level sheet() { return grid::Level(test::sheet()); }

Body discOf(double radius, int levels) {
  auto disc = std::make_shared<input::Cylinder>();
  disc->top = Vec3(0, 0, 0.1);
  disc->radius = radius;
  Body body;
  body.shape = disc;
  body.particlesPerCell = {{2, 2, 1}};
  body.levels = levels;
  return body;
}

std::vector<Seed> seedsOf(const grid::Level& level, Body body) {
  std::vector<Body> bodies{std::move(body)};
  placeParticles(level, bodies);
  std::vector<Seed> all;
  if (bodies.front().seeds)
    for (const auto& [cell, seeds] : *bodies.front().seeds) all.insert(all.end(), seeds.begin(), seeds.end());
  return all;
}

double volumeOf(const grid::Level& level, const std::vector<Seed>& seeds) {
  double sum = 0;
  for (const Seed& seed : seeds) sum += seed.volume * level.cellVolume();
  return sum;
}

TEST(Placement, LeavesBodiesInEqualPartsOfCellsAlone) {
  EXPECT_TRUE(seedsOf(sheet(), discOf(0.9, 1)).empty());
  EXPECT_TRUE(seedsOf(sheet(), discOf(0.9, -1)).empty());
}

TEST(Placement, FillsAShapeUpToItsSurfaceByHalvingParticles) {
  const grid::Level level = sheet();
  const double whole = std::numbers::pi * 0.81 * 0.1;
  for (const int levels : {-2, -3, -4}) {
    const auto seeds = seedsOf(level, discOf(0.9, levels));
    const double lacking = std::abs(volumeOf(level, seeds) - whole) / whole;
    EXPECT_LT(lacking, 0.1 / (1 << -levels)) << levels;
    double smallest = 1;
    for (const Seed& seed : seeds) {
      smallest = std::min(smallest, seed.domain(0, 0));
      EXPECT_EQ(seed.domain(0, 0), seed.domain(1, 1));
      EXPECT_EQ(seed.domain(2, 2), 2 * seed.domain(0, 0)) << "one along z where there are two along x and y";
      EXPECT_DOUBLE_EQ(seed.volume, seed.domain(0, 0) * seed.domain(1, 1) * seed.domain(2, 2));
      EXPECT_LT(seed.at.head<2>().norm(), 0.9);
    }
    EXPECT_EQ(smallest, 0.5 / (1 << (-levels - 1)));
  }
}

TEST(Placement, KeepsLargeParticlesThatStickOutWhereTheNumberIsPositive) {
  const grid::Level level = sheet();
  EXPECT_GT(seedsOf(level, discOf(0.9, 2)).size(), 0u);
  EXPECT_GT(volumeOf(level, seedsOf(level, discOf(0.9, 3))), volumeOf(level, seedsOf(level, discOf(0.9, -3))));
}

TEST(Placement, MovesParticlesAndTheirEdgesByAnAffineMap) {
  const grid::Level level = sheet();
  auto box = std::make_shared<input::Box>();
  box->min = Vec3(0, 0, 0);
  box->max = Vec3(0.25, 0.5, 0.1);  // one cell
  Body body;
  body.shape = box;
  body.particlesPerCell = {{2, 1, 1}};
  body.affineRow0 = Vec3(0, -1, 0);
  body.affineRow1 = Vec3(2, 0, 0);
  body.affineShift = Vec3(0.5, -0.5, 0);
  const auto seeds = seedsOf(level, body);
  ASSERT_EQ(seeds.size(), 2u);
  for (const Seed& seed : seeds) {
    EXPECT_DOUBLE_EQ(seed.at[0], 0.5 - 0.25);
    EXPECT_NEAR(std::abs(seed.at[1] + 0.5 - 0.25), 0.125, 1e-15) << "2 X + b of X = .0625 and .1875 m";
    EXPECT_DOUBLE_EQ(seed.volume, 2 * 0.5);
    const Vec3 widths(0.25, 0.5, 0.1);  // of a cell
    const Matrix3 edges = widths.asDiagonal() * seed.domain;
    EXPECT_NEAR((edges.col(0) - Vec3(0, 2 * 0.125, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR((edges.col(1) - Vec3(-0.5, 0, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR(edges.determinant(), seed.volume * level.cellVolume(), 1e-15);
  }
}

TEST(Placement, RefusesParticlesOutsideOfTheGrid) {
  Body body = discOf(0.5, 1);
  body.affineShift = Vec3(0.75, 0, 0);
  EXPECT_THROW(seedsOf(sheet(), body), InputError);
}

std::shared_ptr<input::SmoothCylinder> ring(input::SmoothCylinder::Scheme scheme) {
  auto shape = std::make_shared<input::SmoothCylinder>();
  shape->scheme = scheme;
  shape->top = Vec3(0, 0, 0.1);
  shape->innerRadius = 0.3;
  shape->outerRadius = 0.9;
  shape->radial = 6;
  shape->axial = 1;
  shape->angular = 60;
  return shape;
}

TEST(Placement, OfASmoothCylinderFollowsItsSurface) {
  const grid::Level level = sheet();
  for (const auto scheme : {input::SmoothCylinder::Scheme::pieSlices, input::SmoothCylinder::Scheme::constantVolumes}) {
    Body body;
    body.shape = ring(scheme);
    const auto seeds = seedsOf(level, body);
    EXPECT_NEAR(volumeOf(level, seeds), std::numbers::pi * (0.81 - 0.09) * 0.1, 1e-12);
    for (const Seed& seed : seeds) {
      const Vec3 widths(0.25, 0.5, 0.1);
      const Matrix3 edges = widths.asDiagonal() * seed.domain;
      Vec3 outwards = seed.at;
      outwards[2] = 0;
      EXPECT_NEAR(edges.col(1).dot(outwards) / outwards.norm(), 0.1, 1e-14) << "the width of a ring, outwards";
      EXPECT_NEAR(edges.col(0).dot(outwards), 0, 1e-14);
      EXPECT_NEAR(std::abs(edges.determinant()), seed.volume * level.cellVolume(), 1e-14);
    }
  }
}

TEST(Placement, OfASmoothCylinderHasNoTinyPieSlices) {
  const auto shape = ring(input::SmoothCylinder::Scheme::pieSlices);
  const auto few = shape->particles(1), many = shape->particles(1e-9);
  EXPECT_EQ(many.size(), 6u * 60);
  EXPECT_LT(few.size(), many.size());
}

TEST(SmoothCylinder, TurnsItsParticlesWithItsAxis) {
  for (const Vec3& axis : {Vec3(0, 0, -2), Vec3(1, 0, 0), Vec3(-1, 2, 0.5), Vec3(1e-9, 1e-10, -1)}) {
    const auto shape = ring(input::SmoothCylinder::Scheme::pieSlices);
    shape->bottom = Vec3(1, 2, 3);
    shape->top = shape->bottom + axis;
    const Vec3 along = axis.normalized();
    for (const auto& particle : shape->particles(1)) {
      EXPECT_TRUE(shape->contains(particle.at));
      EXPECT_NEAR((particle.edges * particle.edges.transpose() * along).dot(along), axis.squaredNorm(), 1e-12);
      EXPECT_NEAR(std::abs(particle.edges.determinant()) / particle.volume, 1, 1e-2);
    }
  }
}

TEST(SmoothCylinder, HoldsWhatIsBetweenItsRadii) {
  const auto shape = ring(input::SmoothCylinder::Scheme::pieSlices);
  EXPECT_TRUE(shape->contains({0.5, 0, 0.05}));
  EXPECT_FALSE(shape->contains({0.2, 0, 0.05}));
  EXPECT_FALSE(shape->contains({0.5, 0, 0.11}));
}

}  // namespace
}  // namespace tushar::mpm::solid
