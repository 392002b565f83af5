#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "components/mpm/solid/explicit/tasks/corner_loads.hpp"
#include "components/mpm/solid/tasks/apply_external_loads.hpp"
#include "tests/support/levels.hpp"
#include "tests/support/particles.hpp"

// Loads on particles, on plain fields.

namespace tushar::mpm::solid {
namespace {

/// A square of one cell with two particles of 2 and 3 kg.
struct TwoParticles : test::Particles {
  TwoParticles() : Particles(test::unitCells(1, 1)) {
    set.reset(grid.patches().front(), 1);
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
  applyExternalLoads<2>(two.grid.patches().front(), two.material, loads, 1, two.read(two.x), two.read(two.mass),
                        two.read(std::vector<int>{0, 1}), std::nullopt, {force.data(), two.set, two.level.cells()});
  EXPECT_EQ(force[0], Vec<2>(0, 0));
  EXPECT_EQ(force[1], Vec<2>(4 * 6 / 4.0, 0)) << "4 Pa at half the time, 6 m^2, 4 particles";
}

TEST(Load, TurnsAPressureButNoBodyForceWithTheParticle) {
  TwoParticles two;
  const Loads loads{{onASquare(SurfaceLoad::Kind::pressure)}, {{Vec3::Zero(), Vec3::Ones(), Vec3(0, -5, 0)}}};
  Matrix3 quarter, stretch = Matrix3::Identity();
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  stretch(0, 0) = 2;
  stretch(0, 1) = stretch(1, 0) = 0.5;
  const std::vector<Matrix3> deformation{Matrix3::Identity(), quarter * stretch};
  std::vector<Vec<2>> force(2);
  applyExternalLoads<2>(two.grid.patches().front(), two.material, loads, 1, two.read(two.x), two.read(two.mass),
                        two.read(std::vector<int>{1, 1 + 256 * 2}), two.read(deformation),
                        {force.data(), two.set, two.level.cells()});
  EXPECT_EQ(force[0], Vec<2>(6, 0));
  EXPECT_NEAR((force[1] - Vec<2>(0, 6 - 15)).norm(), 0, 1e-14) << "F = R U: R turns the pressure by 90 degrees";
}

TEST(Load, PullsBodiesByTheirMass) {
  TwoParticles two;
  const Loads loads{{onASquare(SurfaceLoad::Kind::heatFlux)}, {{Vec3::Zero(), Vec3::Ones(), Vec3(0, -5, 0)}}};
  std::vector<Vec<2>> force(2);
  applyExternalLoads<2>(two.grid.patches().front(), two.material, loads, 1, two.read(two.x), two.read(two.mass),
                        two.read(std::vector<int>{2, 1 + 256 * 2}), std::nullopt,
                        {force.data(), two.set, two.level.cells()});
  EXPECT_EQ(force[0], Vec<2>(0, -10));
  EXPECT_EQ(force[1], Vec<2>(0, -15)) << "heat does not push";
}

TEST(Load, BringsHeatToTheParticlesOfASurface) {
  TwoParticles two;
  const Loads loads{{onASquare(SurfaceLoad::Kind::heatFlux)}, {{Vec3::Zero(), Vec3::Ones(), Vec3(0, -5, 0)}}};
  std::vector<double> heat(2);
  applyHeatFlux<2>(two.grid.patches().front(), two.material, loads, 1, two.read(two.x),
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

input::Cylinder upright() {
  input::Cylinder side;
  side.bottom = Vec3(1, 0, 0);
  side.top = Vec3(1, 0, 3);
  side.radius = 2;
  return side;
}

TEST(Torque, OfAllParticlesIsThatOfTheCurve) {
  SurfaceLoad load{LoadKind::torque, upright(), {{{0, 6}}}, -1, {}};
  const std::vector<Vec3> points{Vec3(3, 0, 1), Vec3(1, 1.9, 2), Vec3(-1.1, 0.3, 0.5)};
  load.particles = static_cast<double>(points.size());
  Vec3 torque = Vec3::Zero();
  for (const Vec3& point : points) torque += (point - upright().bottom).cross(load.force(point, 0));
  EXPECT_NEAR(torque.z(), -6, 1e-14) << "positive against the right-hand rule, as in Uintah";
  EXPECT_EQ(load.force(Vec3(1, 0, 2), 0), Vec3::Zero()) << "on the axis";
}

TEST(Torque, ActsOnTheSideEvenIfTheShapeIsAnEnd) {
  input::Cylinder end = upright();
  end.cylinderEnd = true;
  const Vec3 spacing = Vec3::Constant(0.1), beside(3.05, 0, 1.5), within(1.5, 0, 2.95);
  EXPECT_TRUE(isAlong(end, beside, spacing, LoadKind::torque));
  EXPECT_FALSE(isAlong(end, within, spacing, LoadKind::torque));
  EXPECT_FALSE(isAlong(end, beside, spacing, LoadKind::pressure));
  EXPECT_TRUE(isAlong(end, within, spacing, LoadKind::pressure));
}

/// A particle whose initial edges are .2, .4 and 1 m.
ParticleBox particleAt(const Vec3& middle, const Matrix3& f = Matrix3::Identity()) {
  const Matrix3 start = Vec3(0.2, 0.4, 1).asDiagonal();
  return {middle, start, f * start};
}

/// An axis with one cell does not count, whichever it is: all particles would be at the surface.
TEST(Load, ActsAtSurfacesAlongAxesWithSeveralCells) {
  for (int thin = 0; thin < 3; ++thin) {
    grid::Domain domain;
    domain.upper = Vec3::Constant(4);
    domain.resolution = Index3::filled(4);
    domain.resolution[thin] = 1;
    const grid::Level level(domain);
    auto box = std::make_shared<input::Box>();
    box->max = Vec3::Constant(4);
    Body body;
    body.shape = box;
    const int next = (thin + 1) % 3;
    const Vec3 inside = Vec3::Constant(1.5) + 0.5 * Vec3::Unit(thin), beside = inside - Vec3::Unit(next);
    EXPECT_FALSE(isAtSurface(level, body, inside)) << "thin along axis " << thin;
    EXPECT_TRUE(isAtSurface(level, body, beside)) << "thin along axis " << thin;
  }
}

TEST(CornerLoad, IsThePressureTimesTheAreaAtTheCornersOfAFace) {
  const Loads loads{{onASquare(LoadKind::pressure)}, {}};
  const auto load = cornerLoad(loads, 1, particleAt(Vec3(0.9, 1, 1)), 1);
  ASSERT_TRUE(load);
  EXPECT_LT((load->force - Vec3(4 * 6 / 4.0, 0, 0)).norm(), 1e-14) << "4 Pa at half the time, 6 m^2, 4 particles";
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : load->corners) sum += corner;
  EXPECT_LT((sum / 4 - Vec3(1, 1, 1)).norm(), 1e-14) << "around the middle of the face";
  for (const Vec3& corner : load->corners) {
    EXPECT_NEAR(std::abs(corner.y() - 1), 0.2, 1e-14);
    EXPECT_NEAR(std::abs(corner.z() - 1), 0.5, 1e-14);
  }
}

TEST(CornerLoad, GrowsWithTheFaceAndTakesTheOppositeOneWhereAsked) {
  Loads loads{{onASquare(LoadKind::pressure)}, {}};
  loads.surfaces[0].outwardNormal = false;
  const Matrix3 wider = Vec3(1, 3, 0.5).asDiagonal();
  const auto load = cornerLoad(loads, 1, particleAt(Vec3(0.9, 1, 1), wider), 1);
  ASSERT_TRUE(load);
  EXPECT_NEAR(load->force.x(), 1.5 * 6, 1e-13);
  EXPECT_NEAR(load->corners[0].x(), 0.8, 1e-14);
}

TEST(CornerLoad, IsNoneWithoutAFaceTowardsTheNormal) {
  SurfaceLoad load{LoadKind::pressure, upright(), {{{0, 6}}}, -1, {}};
  load.particles = 1;
  const Loads loads{{load}, {}};
  EXPECT_FALSE(cornerLoad(loads, 1, particleAt(Vec3(2, 1, 1)), 0)) << "45 degrees from both axes";
  EXPECT_TRUE(cornerLoad(loads, 1, particleAt(Vec3(3, 0.1, 1)), 0));
}

TEST(CornerLoad, PutsAllOfAForceOnTheNodesAround) {
  TwoParticles two;
  const Box nodes = two.level.nodes();
  std::vector<NodeRecord> records(nodes.size(), NodeRecord{});
  addForceAt<2>(two.level, Vec<2>(0.25, 0.5), Vec<2>(8, 4), {records.data(), nodes});
  Vec<2> sum = Vec<2>::Zero();
  for (const NodeRecord& record : records) sum += lanes<2>(record, lane::force);
  EXPECT_LT((sum - Vec<2>(8, 4)).norm(), 1e-14);
  EXPECT_EQ(records[nodes.offset(Index3{{0, 0, 0}})][lane::force], 8 * 0.75 * 0.5);
}

TEST(CornerLoad, LeavesOutNodesThatGimpReachesAlmostNotAtAll) {
  const TwoParticles two;
  const double h = two.level.spacing(0), edge = 0.5 * h, node = two.level.nodePosition(0, 1);
  const double barely = node + h + 0.5 * edge - 1e-6 * h, well = node + h + 0.5 * edge - 1e-2 * h;
  EXPECT_NEAR(roomOfCorners<2>(two.level, 0, barely, edge, true)[0], node + h, 1e-15);
  EXPECT_NEAR(roomOfCorners<2>(two.level, 0, well, edge, true)[0], well - h, 1e-15);
  EXPECT_NEAR(roomOfCorners<2>(two.level, 0, barely, edge, false)[0], barely - h, 1e-15);
  const double below = node - h - 0.5 * edge + 1e-6 * h;
  EXPECT_NEAR(roomOfCorners<2>(two.level, 0, below, edge, true)[1], node - h, 1e-15);
}

TEST(Load, ActsOnBodiesInABoxAndAParticlesSpacingBeyond) {
  const BodyLoad load{Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3::Zero()};
  const Vec3 spacing(0.1, 0.1, 0.1);
  EXPECT_TRUE(load.acts(Vec3(0.95, 1.5, 2.05), spacing));
  EXPECT_FALSE(load.acts(Vec3(0.85, 1.5, 1.5), spacing));
}

}  // namespace
}  // namespace tushar::mpm::solid
