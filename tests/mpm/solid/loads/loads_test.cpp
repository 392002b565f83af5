#include <gtest/gtest.h>

#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "tests/support/particles.hpp"

// Loads on particles, on plain fields.

namespace tushar::mpm::solid {
namespace {

/// A square of one cell with two particles, of 2 and 3 kg.
struct TwoParticles : test::Particles {
  static grid::Domain domain() {
    grid::Domain domain;
    domain.upper = {1, 1, 0};
    domain.resolution = {{1, 1, 0}};
    return domain;
  }
  TwoParticles() : Particles(domain()) {
    set.reset(level.patches().front(), 1);
    set.at(Index3{{0, 0, 0}}) = {0, 2};
    set.setOwned(2);
  }

  Material material;
  std::vector<Vec<2>> x{{0.25, 0.5}, {0.75, 0.5}};
  std::vector<double> mass{2, 3};
};

SurfaceLoad onASquare(SurfaceLoad::Kind kind) {
  SurfaceLoad load{kind, input::Box(), {{{0, 0}, {2, 8}}}, -1, {}};
  std::get<input::Box>(load.surface).min = Vec3(1, 0, 0);
  std::get<input::Box>(load.surface).max = Vec3(1, 2, 3);
  load.particles = 4;
  return load;
}

TEST(Load, SharesAPressureAmongTheParticlesOfASurface) {
  TwoParticles two;
  const Loads loads{{onASquare(SurfaceLoad::Kind::pressure)}, {}};
  std::vector<Vec<2>> force(2);
  applyExternalLoads<2>(two.level.patches().front(), two.material, loads, 1, two.read(two.x), two.read(two.mass),
                        two.read(std::vector<int>{0, 1}), {force.data(), two.set, two.level.cells()});
  EXPECT_EQ(force[0], Vec<2>(0, 0));
  EXPECT_EQ(force[1], Vec<2>(4 * 6 / 4.0, 0)) << "4 Pa at half the time, 6 m^2, 4 particles";
}

TEST(Load, PullsBodiesByTheirMass) {
  TwoParticles two;
  const Loads loads{{onASquare(SurfaceLoad::Kind::heatFlux)}, {{Vec3::Zero(), Vec3::Ones(), Vec3(0, -5, 0)}}};
  std::vector<Vec<2>> force(2);
  applyExternalLoads<2>(two.level.patches().front(), two.material, loads, 1, two.read(two.x), two.read(two.mass),
                        two.read(std::vector<int>{2, 1 + 256 * 2}), {force.data(), two.set, two.level.cells()});
  EXPECT_EQ(force[0], Vec<2>(0, -10));
  EXPECT_EQ(force[1], Vec<2>(0, -15)) << "heat does not push";
}

TEST(Load, BringsHeatToTheParticlesOfASurface) {
  TwoParticles two;
  const Loads loads{{onASquare(SurfaceLoad::Kind::heatFlux)}, {{Vec3::Zero(), Vec3::Ones(), Vec3(0, -5, 0)}}};
  std::vector<double> heat(2);
  applyHeatFlux<2>(two.level.patches().front(), two.material, loads, 1, two.read(two.x),
                   two.read(std::vector<int>{2, 1 + 256 * 2}), {heat.data(), two.set, two.level.cells()});
  EXPECT_EQ(heat[0], 0);
  EXPECT_EQ(heat[1], 4 * 6 / 4.0);
}

TEST(Load, OnAnAxisymmetricEndIsSharedByRadius) {
  input::Cylinder end;
  end.top = Vec3(0, 1, 0);
  end.radius = 2;
  end.axisymmetricEnd = true;
  SurfaceLoad load{SurfaceLoad::Kind::pressure, end, {{{0, 6}}}, -1, {}};
  load.particles = 0.5 + 1.5;  // two particles, .5 and 1.5 m from the axis
  // p r dr for each, and together the pressure times the area of a radian, R²/2.
  EXPECT_DOUBLE_EQ(load.force(Vec3(0.5, 1, 0), 0)[1], 6 * 0.5);
  EXPECT_DOUBLE_EQ(load.force(Vec3(1.5, 1, 0), 0)[1], 6 * 1.5);
}

TEST(Load, ActsOnBodiesInABoxAndAParticlesSpacingBeyond) {
  const BodyLoad load{Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3::Zero()};
  const Vec3 spacing(0.1, 0.1, 0.1);
  EXPECT_TRUE(load.acts(Vec3(0.95, 1.5, 2.05), spacing));
  EXPECT_FALSE(load.acts(Vec3(0.85, 1.5, 1.5), spacing));
}

}  // namespace
}  // namespace tushar::mpm::solid
