#include "components/mpm/solid/tasks/create_particles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/input/geometry/shapes.hpp"
#include "tests/support/levels.hpp"
#include "tests/support/run.hpp"

namespace tushar::mpm::solid {

namespace {

/// A row of 32 cells of 1/32 m; between two positions each is divided into 4 finest cells.
grid::Domain row(double lower, double upper) {
  grid::Domain domain;
  domain.upper = {1, 0, 0};
  domain.resolution = {{32, 1, 1}};
  domain.refinement.levels = 3;
  if (upper > lower) domain.refinement.regions.push_back({2, Vec3(lower, 0, 0), Vec3(upper, 0, 0)});
  return domain;
}

/// A plate in the finest cells 39 and 40, away from the centres of the coarsest cells 9 and 10, with a small shift.
Material plate(double shift) {
  auto shape = std::make_shared<input::Box>();
  shape->min = Vec3(39.0 / 128, -1, -1);
  shape->max = Vec3(41.0 / 128, 1, 1);
  Body body;
  body.shape = shape;
  body.velocity = *input::VectorExpression::parse("[0,0,0]");
  body.temperature = *input::Expression::parse("300");
  body.affineShift = Vec3(shift, 0, 0);
  Material material;
  material.name = "plate";
  material.density = 1;
  material.bodies.push_back(std::move(body));
  return material;
}

/// Returns the number of particles by level and cell.
std::map<std::pair<int, int>, int> made(const grid::Domain& domain, double shift) {
  test::Runner run(domain);
  std::vector<Material> materials{plate(shift)};
  placeParticles(run.grid.finest(), materials[0].bodies);
  TaskList list;
  list.newParticles("create", actuallyInitialize<1>, materials, with(Start()), all<NewParticles<1>>());
  tasks::TaskGraph graph = run.compile(list, {"p.x", "p.mass", "p.particleID"});
  run.step(graph);
  std::map<std::pair<int, int>, int> counts;
  for (const Patch& patch : run.grid.patches())
    forEach<1>(patch.cells(), [&](const Index<1>& cell) {
      const data::ParticleSet& set = run.warehouse.particles(data::Generation::old, 0, patch.id());
      if (const int count = set.in(Index3{{cell[0], 0, 0}}).size(); count > 0)
        counts[{patch.level().number(), cell[0]}] = count;
    });
  return counts;
}

using Counts = std::map<std::pair<int, int>, int>;

/// The mass of a ball of radius .05 m and 1 kg/m^3, whose centre is `height` above the bottom of a sheet .1 m thick.
double massOfBall(double height, const Index3& particlesPerCell, int levels, bool fillsDepth) {
  test::Runner run(test::sheet());
  auto ball = std::make_shared<input::Sphere>();
  ball->origin = Vec3(0.01, 0.02, height);
  ball->radius = 0.05;
  Body body;
  body.shape = ball;
  body.particlesPerCell = particlesPerCell;
  body.levels = levels;
  body.fillsDepth = fillsDepth;
  std::vector<Material> materials(1);
  materials[0].density = 1;
  materials[0].bodies.push_back(body);
  placeParticles(run.grid.finest(), materials[0].bodies);
  TaskList list;
  list.newParticles("create", actuallyInitialize<2>, materials, with(Start()), all<NewParticles<2>>());
  const data::ReductionLabel<Sum> mass{"mass", "kg", "mass"};
  list.perMaterial(
      "sum",
      [](const Patch&, const Material&, ParticleView<const double> masses, Sum& sum) {
        for (int p = 0; p < masses.owned(); ++p) sum.add(masses[p]);
      },
      materials, requiresNew(p::mass), computes(mass));
  tasks::TaskGraph graph = run.compile(list, {"p.x", "p.mass", "p.particleID", "mass"});
  run.step(graph);
  return run.warehouse.reductionValues(run.table.find("mass", -1)).at(0);
}

}  // namespace

TEST(CreateParticles, MakeThemInTheFinestCells) {
  EXPECT_EQ(made(row(0.25, 0.5), 0), (Counts{{{2, 39}, 1}, {{2, 40}, 1}}));
  EXPECT_EQ(made(row(0.25, 0.5), 1.0 / 1024), (Counts{{{2, 39}, 1}, {{2, 40}, 1}}));
}

TEST(CreateParticles, HaveOneInACoarserCellForAllThatAreTooFineForIt) {
  EXPECT_EQ(made(row(0, 0), 0), (Counts{{{0, 9}, 1}, {{0, 10}, 1}}));
  EXPECT_EQ(made(row(0, 0), 1.0 / 1024), (Counts{{{0, 9}, 1}, {{0, 10}, 1}}));
}

TEST(CreateParticles, HaveThePartOfTheDepthThatTheirBodyFills) {
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(0.05, 3), depth = 0.1;
  const double disc = std::numbers::pi * std::pow(0.05, 2) * depth;
  for (const int levels : {1, -2}) {  // some 80 particles, so their sum is coarse
    EXPECT_NEAR(massOfBall(0.05, {{32, 32, 32}}, levels, false) / volume, 1, 0.04);
    EXPECT_NEAR(massOfBall(0, {{32, 32, 32}}, levels, false) / volume, 0.5, 0.02) << "half of it is below the sheet";
  }
  EXPECT_NEAR(massOfBall(0.05, {{32, 32, 1}}, 1, false) / disc, 1, 0.04) << "one layer, in the middle";
  EXPECT_NEAR(massOfBall(0.05, {{32, 32, 32}}, 1, true) / disc, 1, 0.04);
}

}  // namespace tushar::mpm::solid
