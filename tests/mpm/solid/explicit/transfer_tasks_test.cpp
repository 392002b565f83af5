#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <random>

#include "components/mpm/shapes/cpdi_shape.hpp"
#include "components/mpm/solid/constitutive/ideal_gas.hpp"
#include "components/mpm/solid/constitutive/model.hpp"
#include "components/mpm/solid/explicit/tasks/affine.hpp"
#include "components/mpm/solid/explicit/tasks/deform_particles.hpp"
#include "components/mpm/solid/explicit/tasks/gradient_enhanced.hpp"
#include "components/mpm/solid/explicit/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/explicit/tasks/update_in_parts.hpp"
#include "components/mpm/solid/explicit/tasks/velocity_updates.hpp"
#include "components/mpm/solid/transfer/cpdi_transfer.hpp"
#include "tests/support/particles.hpp"

// The bodies of the transfer tasks on plain fields: no scheduler, no warehouse, no scene.

namespace tushar::mpm::solid {
namespace {

// Sums of some thousand numbers of order 1 that cancel.
constexpr double roundOff = 1e-12;

/// Particles at random positions in the inner cells of a grid without walls, with random values.
template <class Shape>
struct Cloud : test::Particles {
  static constexpr int D = Shape::dimension;

  Material material;
  Method method;
  std::vector<Vec<D>> x, v;
  std::vector<double> mass, volume;
  std::vector<Matrix3> stress, deformation, moment;
  std::vector<NodeRecord> records;
  std::mt19937 random{7};

  static grid::Domain domain() {
    grid::Domain domain;
    domain.upper = {1, D > 1 ? 0.6 : 0, D > 2 ? 0.4 : 0};
    domain.resolution = D == 1 ? Index3{{10, 0, 0}} : D == 2 ? Index3{{10, 8, 0}} : Index3{{9, 8, 7}};
    domain.nodesBeyond = 1;
    return domain;
  }

  Cloud() : Particles(domain()) {
    material.density = 1;
    material.model = std::make_shared<ModelOf<IdealGas>>(IdealGas{});
    method.commonSize = {0.5, 0.5, 0.5};
    set.reset(patch(), Shape::reach);
    forEach<3>(level.cells(), [&](const Index3& cell) {
      const int first = static_cast<int>(x.size());
      bool inner = true;
      for (int d = 0; d < D; ++d) inner = inner && cell[d] > 1 && cell[d] < level.cells().upper[d] - 2;
      for (int k = 0; inner && k < 3; ++k) add(cell);
      set.at(cell) = {first, static_cast<int>(x.size())};
    });
    set.setOwned(static_cast<int>(x.size()));
    records.resize(level.nodes().size());
  }
  double number() { return std::uniform_real_distribution<double>(-1, 1)(random); }
  void add(const Index3& cell) {
    Vec<D> at, speed;
    for (int d = 0; d < D; ++d) {
      at[d] = level.nodePosition(d, cell[d]) + 0.5 * (1 + number()) * level.spacing(d);
      speed[d] = number();
    }
    x.push_back(at);
    v.push_back(speed);
    mass.push_back(1.5 + number());
    volume.push_back(0.001 * (1.5 + number()));
    Matrix3 any;
    for (int i = 0; i < 9; ++i) any(i / 3, i % 3) = number();
    stress.push_back(any + any.transpose());
    deformation.push_back(Matrix3::Identity() + 0.2 * any);
    moment.push_back(any * level.spacing(0));
  }
  NodeView<NodeRecord> nodes() { return {records.data(), level.nodes()}; }
  NodeView<const NodeRecord> nodes() const { return {records.data(), level.nodes()}; }

  Placed<D> placed() const { return {.x = read(x), .size = {}, .deformation = read(deformation)}; }

  void toGrid(bool withStress) {
    const MomentumSources<D> from{
        .x = read(x), .size = {}, .mass = read(mass), .velocity = read(v), .deformation = read(deformation)};
    if (withStress)
      interpolateParticlesToGrid<Shape>(
          patch(), material, method.commonSize, true, from,
          {.volume = read(volume), .stress = read(stress), .viscosity = {}, .externalForce = {}}, nodes());
    else
      interpolateMomentum<Shape>(patch(), material, method.commonSize, true, from, nodes());
  }
  /// Calls `visit(position, record)` for each node.
  template <class Visit>
  void forEachNode(Visit&& visit) const {
    forEach<D>(level.nodes(), [&](const Index<D>& node) {
      Vec<D> at;
      for (int d = 0; d < D; ++d) at[d] = level.nodePosition(d, node[d]);
      visit(level.expandDirection<D>(at), nodes()[node]);
    });
  }
  Vec3 wide(const Vec<D>& reduced) const { return level.expandDirection<D>(reduced); }
};

template <class Shape>
class Transfer : public testing::Test {};
using Shapes = testing::Types<LinearShape<2>, GimpShape<1>, GimpShape<2>, GimpShape<3>, CpdiShape<2>, CpdiShape<3>,
                              QuadraticShape<2>, CubicShape<2>>;
TYPED_TEST_SUITE(Transfer, Shapes);

TYPED_TEST(Transfer, BringsAllMassAndMomentumToTheGrid) {
  constexpr int D = TypeParam::dimension;
  Cloud<TypeParam> cloud;
  cloud.toGrid(false);
  double mass = 0;
  Vec3 momentum = Vec3::Zero();
  cloud.forEachNode([&](const Vec3&, const NodeRecord& record) {
    mass += record[lane::mass];
    momentum += record[lane::mass] * cloud.wide(lanes<D>(record, lane::velocity));
    EXPECT_EQ(lanes<D>(record, lane::force).norm(), 0) << "no stress, no force";
  });
  for (std::size_t p = 0; p < cloud.x.size(); ++p) {
    mass -= cloud.mass[p];
    momentum -= cloud.mass[p] * cloud.wide(cloud.v[p]);
  }
  EXPECT_NEAR(mass, 0, roundOff);
  EXPECT_LT(momentum.norm(), roundOff);
}

TYPED_TEST(Transfer, MakesForcesThatNeitherPushNorTurnTheWhole) {
  constexpr int D = TypeParam::dimension;
  Cloud<TypeParam> cloud;
  cloud.toGrid(true);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  double greatest = 0;
  cloud.forEachNode([&](const Vec3& x, const NodeRecord& record) {
    const Vec3 f = cloud.wide(lanes<D>(record, lane::force));
    force += f;
    torque += x.cross(f);
    greatest = std::max(greatest, f.norm());
  });
  EXPECT_GT(greatest, 1e-3);
  EXPECT_LT(force.norm(), roundOff);
  EXPECT_LT(torque.norm(), roundOff);
}

TYPED_TEST(Transfer, GivesAUniformVelocityBackAsItWas) {
  constexpr int D = TypeParam::dimension;
  Cloud<TypeParam> cloud;
  Vec<D> common;
  for (int d = 0; d < D; ++d) common[d] = 1 + d;
  for (Vec<D>& v : cloud.v) v = common;
  cloud.toGrid(false);
  for (NodeRecord& record : cloud.records) setLanes<D>(record, lane::before, lanes<D>(record, lane::velocity));
  std::vector<Vec<D>> x, v, smooth;
  const auto& c = cloud;
  moveParticles<TypeParam>(c.patch(), c.material, c.method.commonSize, 0.01,
                           {.record = c.nodes(),
                            .particles = c.placed(),
                            .velocity = c.read(c.v),
                            .newX = c.write(x),
                            .newVelocity = c.write(v)});
  computeSSPlusVp<TypeParam>(c.patch(), c.material, c.method.commonSize, c.nodes(), c.placed(), c.write(smooth));
  for (std::size_t p = 0; p < x.size(); ++p) {
    EXPECT_LT((x[p] - c.x[p] - 0.01 * common).norm(), roundOff);
    EXPECT_LT((v[p] - common).norm(), roundOff);
    EXPECT_LT((smooth[p] - common).norm(), roundOff);
  }
}

TEST(DeformationGradient, IsMultipliedByThatOfTheStep) {
  Matrix3 f, gradient;
  f << 1.1, 0.2, -0.1, 0.3, 0.9, 0.05, -0.2, 0.1, 1.2;
  gradient << 3, -1, 2, 0.5, 4, -2, 1, 1.5, -3;
  const double dt = 0.01;
  for (const int n : {1, 4}) {
    Matrix3 expected = f, result;
    for (int k = 0; k < n; ++k) expected = (Matrix3::Identity() + gradient * (dt / n)) * expected;
    deform(f, gradient, dt, n, result);
    EXPECT_LT((result - expected).norm(), 1e-15 * n);
  }
}

TEST(Blend, TakesTheGridsVelocityByItsShare) {
  Cloud<GimpShape<2>> cloud;
  cloud.toGrid(false);
  std::vector<Vec<2>> pic = cloud.v, half = cloud.v;
  const auto& c = cloud;
  cloud.method.picFraction = 1;
  blendVelocity<GimpShape<2>>(c.patch(), c.material, c.method, c.nodes(), c.placed(), c.write(pic));
  cloud.method.picFraction = 0.5;
  blendVelocity<GimpShape<2>>(c.patch(), c.material, c.method, c.nodes(), c.placed(), c.write(half));
  for (std::size_t p = 0; p < pic.size(); ++p) EXPECT_LT((half[p] - 0.5 * (pic[p] + c.v[p])).norm(), roundOff);
}

template <class Shape>
class Affine : public testing::Test {};
using AffineShapes = testing::Types<LinearShape<2>, LinearShape<3>, GimpShape<2>, GimpShape<3>, QuadraticShape<2>,
                                    QuadraticShape<3>, CubicShape<2>>;
TYPED_TEST_SUITE(Affine, AffineShapes);

TYPED_TEST(Affine, KeepsAngularMomentumToTheGridAndBack) {
  constexpr int D = TypeParam::dimension;
  Cloud<TypeParam> cloud;
  const auto& c = cloud;
  const auto spin = [&](const std::vector<Vec<D>>& v, const std::vector<Matrix3>& b) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t p = 0; p < v.size(); ++p) {
      sum += c.mass[p] * c.wide(c.x[p]).cross(c.wide(v[p]));
      for (int i = 0; i < D; ++i) {
        Vec<D> unit = Vec<D>::Zero();
        unit[i] = 1;
        const Vec<D> column = b[p].template topLeftCorner<D, D>().col(i);
        sum += c.mass[p] * c.wide(unit).cross(c.wide(column));
      }
    }
    return sum;
  };
  const Vec3 before = spin(c.v, c.moment);
  cloud.toGrid(false);
  addAffineVelocity<TypeParam>(c.patch(), c.material, c.method.commonSize, c.placed(), c.read(c.mass), c.read(c.moment),
                               cloud.nodes());
  Vec3 onGrid = Vec3::Zero();
  cloud.forEachNode([&](const Vec3& x, const NodeRecord& record) {
    onGrid += record[lane::mass] * x.cross(cloud.wide(lanes<D>(record, lane::velocity)));
  });
  std::vector<Vec<D>> v = c.v;
  std::vector<Matrix3> b;
  cloud.method.picFraction = 1;
  blendVelocity<TypeParam>(c.patch(), c.material, c.method, c.nodes(), c.placed(), c.write(v));
  updateAffineMoment<TypeParam>(c.patch(), c.material, c.method.commonSize, c.nodes(), c.placed(), c.write(b));
  EXPECT_LT((onGrid - before).norm(), roundOff * 10) << "sums of order 10";
  EXPECT_LT((spin(v, b) - before).norm(), roundOff * 10);
}

/// With velocity gradients, linear velocity fields are transferred to the nodes exactly; without them they are not.
TYPED_TEST(Transfer, GivesNodesTheVelocityThatAGradientMakesThere) {
  constexpr int D = TypeParam::dimension;
  Cloud<TypeParam> cloud;
  Matrix3 gradient;
  gradient << 0.3, -0.2, 0.5, 0.7, 0.1, -0.4, -0.6, 0.2, 0.8;
  const Eigen::Matrix<double, D, D> inKernel = gradient.topLeftCorner<D, D>();
  for (std::size_t p = 0; p < cloud.v.size(); ++p) cloud.v[p] = inKernel * cloud.x[p];
  cloud.toGrid(false);
  const auto& c = cloud;
  const std::vector<Matrix3> gradients(c.x.size(), gradient);
  const auto farthest = [&] {
    double most = 0;
    cloud.forEachNode([&](const Vec3& x, const NodeRecord& record) {
      if (record[lane::mass] > 1e-9)
        most = std::max(most, (lanes<D>(record, lane::velocity) - inKernel * x.head<D>()).norm());
    });
    return most;
  };
  EXPECT_GT(farthest(), 1e-3);
  addVelocityGradient<TypeParam>(c.patch(), c.material, c.method.commonSize, c.placed(), c.read(c.mass),
                                 c.read(gradients), cloud.nodes());
  EXPECT_LT(farthest(), 1e-8) << "round-off, by masses of nodes above 1e-9";
}

TEST(LimitVelocity, SlowsDownWhatHasBecomeFasterAndLeavesWhatWasFastBefore) {
  Cloud<LinearShape<1>> cloud;
  std::vector<Vec<1>> before(cloud.x.size(), Vec<1>(1)), after(cloud.x.size(), Vec<1>(-20));
  before[1] = Vec<1>(30);
  after[2] = Vec<1>(9);
  limitVelocity<1>(cloud.patch(), cloud.material, 10, {before.data(), cloud.set, cloud.level.cells()},
                   {after.data(), cloud.set, cloud.level.cells()});
  EXPECT_DOUBLE_EQ(after[0][0], -9);
  EXPECT_EQ(after[1][0], -20);
  EXPECT_EQ(after[2][0], 9);
}

/// The maximum speed is found in batches of the width of a SIMD register.
TEST(CrossingRate, IsOfTheGreatestSpeedWhereverItStands) {
  const Cloud<LinearShape<1>> cloud;
  for (int count = 1; count <= 2 * Lanes::count + 1; ++count)
    for (int place = 0; place < count; ++place) {
      std::vector<double> speeds(count, 1);
      const std::vector<Vec<1>> still(count, Vec<1>(0));
      CrossingRate<1> alone(cloud.level), rate(cloud.level), unknown(cloud.level);
      speeds[place] = 3;
      rate.add(speeds.data(), still.data(), count);
      alone.add(3, Vec<1>(0));
      EXPECT_EQ(rate.time(), alone.time()) << place << " of " << count;
      speeds[place] = std::nan("");
      unknown.add(speeds.data(), still.data(), count);
      EXPECT_FALSE(unknown.isKnown()) << place << " of " << count;
      EXPECT_TRUE(std::isnan(unknown.time()));
    }
}

TEST(CrossingRate, KnowsThatASpeedIsNoNumberWhateverFollows) {
  const Cloud<LinearShape<1>> cloud;
  CrossingRate<1> rate(cloud.level);
  rate.add(2, Vec<1>(0));
  EXPECT_TRUE(rate.isKnown());
  rate.add(std::nan(""), Vec<1>(0));
  rate.add(2, Vec<1>(0));
  EXPECT_FALSE(rate.isKnown());
}

}  // namespace
}  // namespace tushar::mpm::solid
