#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "components/mpm/shapes/cpdi_shape.hpp"
#include "components/mpm/solid/transfer/cpdi_transfer.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/gathered_lanes.hpp"
#include "tests/mpm/shapes/somewhere.hpp"

namespace tushar::mpm::solid {
namespace {

// Nodes number about ten along an axis, so that sums of S x are of order 1 and round-off of order 1e-15: 1e-13 leaves
// room for the 64 terms of a cubic stencil in three dimensions, and for the condition of a sheared domain.
constexpr double roundOff = 1e-13;

template <class Shape>
struct Sums {
  static constexpr int D = Shape::dimension;
  double value = 0;
  Vec<D> gradient = Vec<D>::Zero(), position = Vec<D>::Zero();
  Eigen::Matrix<double, D, D> positionGradient = Eigen::Matrix<double, D, D>::Zero();
  double hoop = 0;

  Sums(const Level& level, const typename Shape::Stencil& stencil) {
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& ds) {
      Vec<D> at;
      for (int d = 0; d < D; ++d) at[d] = level.nodePosition(d, node[d]);
      value += s;
      gradient += ds;
      position += s * at;
      positionGradient += at * ds.transpose();
    });
  }
};

template <class Shape>
class EveryShape : public testing::Test {};
using Shapes = testing::Types<LinearShape<1>, LinearShape<2>, LinearShape<3>, GimpShape<1>, GimpShape<2>, GimpShape<3>,
                              CpdiShape<1>, CpdiShape<2>, CpdiShape<3>, QuadraticShape<1>, QuadraticShape<2>,
                              QuadraticShape<3>, CubicShape<1>, CubicShape<2>, CubicShape<3>>;
TYPED_TEST_SUITE(EveryShape, Shapes);

TYPED_TEST(EveryShape, AddsUpToOneWithoutSlopeAndReproducesStraightLines) {
  constexpr int D = TypeParam::dimension;
  const Level level = grid<D>();
  std::mt19937 random(1);
  for (int k = 0; k < 2000; ++k) {
    const Somewhere<D> p(level, random);
    const Sums<TypeParam> sums(level, typename TypeParam::Stencil(level, p.cell, p.x, p.extent));
    EXPECT_NEAR(sums.value, 1, roundOff);
    EXPECT_LT((sums.position - p.x).cwiseAbs().maxCoeff(), roundOff);
    for (int d = 0; d < D; ++d) EXPECT_LT(std::abs(sums.gradient[d]) * level.spacing(d), roundOff);
    const auto error = sums.positionGradient - Eigen::Matrix<double, D, D>::Identity();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 10 * roundOff) << "slopes of order 1/h = 10";
  }
}

TYPED_TEST(EveryShape, TouchesOnlyNodesThatItSaysItDoes) {
  constexpr int D = TypeParam::dimension;
  const Level level = grid<D>();
  std::mt19937 random(2);
  for (int k = 0; k < 500; ++k) {
    const Somewhere<D> p(level, random);
    const typename TypeParam::Stencil stencil(level, p.cell, p.x, p.extent);
    stencil.forEachNode([&](const Index<D>& node, double, const Vec<D>&) {
      for (int d = 0; d < D; ++d) {
        EXPECT_GE(node[d], p.cell[d] - TypeParam::ghostNodes);
        EXPECT_LE(node[d], p.cell[d] + 1 + TypeParam::ghostNodes);
      }
    });
  }
}

/// The records of the nodes around a particle, one after another.
template <class Shape>
struct Nodes {
  static constexpr int D = Shape::dimension, n = Shape::Stencil::nodes;
  std::vector<NodeRecord> records;
  NodeWindow<NodeRecord, D> window;

  Nodes() {
    std::ptrdiff_t stride = 1;
    for (std::size_t d = 0; d < D; ++d, stride *= n) window.stride[d] = stride;
    records.assign(stride, NodeRecord{});
    window.origin = records.data();
  }
  NodeRecord& at(const Index<D>& offset) {
    std::ptrdiff_t k = 0;
    for (int d = 0; d < D; ++d) k += offset[d] * window.stride[d];
    return records[k];
  }
};

TYPED_TEST(EveryShape, ScattersWhatItsNodesSay) {
  constexpr int D = TypeParam::dimension;
  const Level level = grid<D>();
  std::mt19937 random(3);
  const NodeRecord value{Quad{1, 2, 3, 4}, Quad{5, 6, 7, 8}};
  std::array<Quad, D> slope;
  for (std::size_t d = 0; d < D; ++d) slope[d] = Quad{1.0 + static_cast<double>(d), -2, .5, 0};
  for (int k = 0; k < 50; ++k) {
    const Somewhere<D> p(level, random);
    const typename TypeParam::Stencil stencil(level, p.cell, p.x, p.extent);
    Nodes<TypeParam> nodes;
    scatter(stencil, nodes.window, value, slope);
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
      const NodeRecord& record = nodes.at(node - stencil.first);
      for (int lane = 0; lane < 8; ++lane) {
        double expected = s * value[lane];
        for (int d = 0; d < D && lane >= 4; ++d) expected += gradient[d] * slope[d][lane - 4];
        EXPECT_NEAR(record[lane], expected, 100 * roundOff) << "sums of order 100";
      }
    });
  }
}

TYPED_TEST(EveryShape, GathersWhatItsNodesSay) {
  constexpr int D = TypeParam::dimension;
  const Level level = grid<D>();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 50; ++k) {
    const Somewhere<D> p(level, random);
    const typename TypeParam::Stencil stencil(level, p.cell, p.x, p.extent);
    Nodes<TypeParam> nodes;
    for (NodeRecord& record : nodes.records)
      for (int lane = 0; lane < 8; ++lane) record[lane] = uniform(random);
    std::array<double, 8> value{};
    Eigen::Matrix<double, 4, D> gradient = Eigen::Matrix<double, 4, D>::Zero();
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& ds) {
      const NodeRecord& record = nodes.at(node - stencil.first);
      for (int lane = 0; lane < 8; ++lane) value[lane] += s * record[lane];
      for (int lane = 0; lane < 4; ++lane)
        for (int d = 0; d < D; ++d) gradient(lane, d) += record[lane] * ds[d];
    });
    const Gathered<D> sums = gather(stencil, NodeWindow<const NodeRecord, D>{nodes.window.origin, nodes.window.stride});
    for (int lane = 0; lane < 8; ++lane) EXPECT_NEAR(sums.value[lane], value[lane], roundOff);
    for (int lane = 0; lane < 4; ++lane)
      for (int d = 0; d < D; ++d)
        EXPECT_NEAR(sums.gradient[d][lane], gradient(lane, d), 100 * roundOff) << "of order 10";
  }
}

template <class Shape>
void expectSameBitsInLanes() {
  constexpr int D = Shape::dimension;
  const Level level = grid<D>();
  std::mt19937 random(6);
  const NodeRecord value{Quad{1, 2, 3, 4}, Quad{5, 6, 7, 8}};
  std::array<Quad, D> slope;
  for (std::size_t d = 0; d < D; ++d) slope[d] = Quad{1.0 + static_cast<double>(d), -2, .5, 0};
  const Quad hoop{.25, 0, 0, 0};
  for (int trial = 0; trial < 200; ++trial) {
    const InOneCell<Shape> particles(level, random);
    const auto stencils = particles.stencils(level);
    for (int k = 0; k < particles.count; ++k) {
      const typename Shape::Stencil alone(level, particles.cell, particles.x[k], particles.extent);
      ASSERT_EQ(stencils[k].first, alone.first);
      Nodes<Shape> one, other;
      scatter(alone, one.window, value, slope, hoop);
      scatter(stencils[k], other.window, value, slope, hoop);
      EXPECT_EQ(std::memcmp(one.records.data(), other.records.data(), sizeof(NodeRecord) * one.records.size()), 0);
    }
  }
}

TYPED_TEST(EveryShape, HasTheSameBitsInLanes) {
  if constexpr (!TypeParam::deforms) expectSameBitsInLanes<TypeParam>();
}

TYPED_TEST(EveryShape, GathersTheSameBitsForSeveralParticles) {
  constexpr int D = TypeParam::dimension;
  if constexpr (!TypeParam::deforms) {
    const Level level = grid<D>();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Box stored{{}, Index3::filled(1)};
    for (int d = 0; d < D; ++d) {
      stored.lower[d] = -2;
      stored.upper[d] = level.cells().upper[d] + 3;
    }
    std::vector<NodeRecord> records(static_cast<std::size_t>(stored.size()));
    for (NodeRecord& record : records)
      for (int lane = 0; lane < 8; ++lane) record[lane] = uniform(random);
    const NodeView<const NodeRecord> view(records.data(), stored, stored);
    for (int trial = 0; trial < 200; ++trial) {
      const InOneCell<TypeParam> particles(level, random);
      const Vec3 size = level.template expandPoint<D>(particles.extent.size);
      const Extents<TypeParam> extents(level, size, {}, {});
      const GatheredLanes<D> sums = gatherLanes(CellFrame<D>(level, particles.cell), particles.cell, particles.x.data(),
                                                extents, 0, particles.count, view);
      for (int k = 0; k < particles.count; ++k) {
        const typename TypeParam::Stencil alone(level, particles.cell, particles.x[k], particles.extent);
        const Gathered<D> expected = gather(alone, windowOf<const NodeRecord>(view, alone));
        for (std::size_t i = 0; i < D; ++i) {
          EXPECT_EQ(sums.after[i][k], expected.value[lane::velocity + static_cast<int>(i)]);
          EXPECT_EQ(sums.before[i][k], expected.value[lane::before + static_cast<int>(i)]);
          for (std::size_t d = 0; d < D; ++d)
            EXPECT_EQ(sums.gradient[d][i][k], expected.gradient[d][static_cast<int>(i)]);
        }
      }
    }
  }
}

template <class Shape>
class AxisymmetricShape : public testing::Test {};
using AxisymmetricShapes =
    testing::Types<AxisymmetricLinearShape<1>, AxisymmetricLinearShape<2>, AxisymmetricGimpShape<1>,
                   AxisymmetricGimpShape<2>, AxisymmetricCpdiShape<1>, AxisymmetricCpdiShape<2>>;
TYPED_TEST_SUITE(AxisymmetricShape, AxisymmetricShapes);

TYPED_TEST(AxisymmetricShape, HasNoStrainInRestAndOneInRadialStretching) {
  constexpr int D = TypeParam::dimension;
  const Level level = grid<D>();
  std::mt19937 random(5);
  for (int k = 0; k < 2000; ++k) {
    Somewhere<D> p(level, random);
    if (p.x[0] < 1e-3) continue;  // S / r of a point on the axis has no meaning
    const typename TypeParam::Stencil stencil(level, p.cell, p.x, p.extent);
    const Sums<TypeParam> sums(level, stencil);
    EXPECT_NEAR(sums.value, 1, roundOff);
    for (int d = 0; d < D; ++d) EXPECT_LT(std::abs(sums.gradient[d]) * level.spacing(d), roundOff);
    double hoop = 0;
    Box nodes{{}, Index3::filled(1)};
    for (int d = 0; d < D; ++d) {
      nodes.lower[d] = stencil.first[d];
      nodes.upper[d] = stencil.first[d] + TypeParam::Stencil::nodes;
    }
    forEach<D>(nodes, [&](const Index<D>& node) { hoop += hoopOf(stencil, node) * level.nodePosition(0, node[0]); });
    EXPECT_NEAR(hoop, 1, 10 * roundOff) << "v_r = r: the hoop strain rate is 1";
    EXPECT_NEAR(sums.positionGradient(0, 0), 1, 10 * roundOff);
  }
}

TYPED_TEST(AxisymmetricShape, HasTheSameBitsInLanes) {
  if constexpr (!TypeParam::deforms) expectSameBitsInLanes<TypeParam>();
}

TEST(CpdiDomain, IsShrunkWhereItReachesFartherThanACell) {
  const Level level = grid<2>();
  Extent<2> extent;
  extent.halfEdges << 3, 0.5, 0, 0.25;
  const Index<2> cell{{4, 3}};
  const Vec<2> x(level.nodePosition(0, 4) + 0.3 * level.spacing(0), level.nodePosition(1, 3) + 0.9 * level.spacing(1));
  const CpdiShape<2>::Stencil stencil(level, cell, x, extent);
  const Sums<CpdiShape<2>> sums(level, stencil);
  EXPECT_NEAR(sums.value, 1, roundOff);
  EXPECT_LT((sums.position - x).norm(), roundOff);
  for (int c = 0; c < 4; ++c)
    for (int d = 0; d < 2; ++d) EXPECT_TRUE(stencil.cellOf[d][c] >= 0 && stencil.cellOf[d][c] <= 2);
}

TEST(CpdiDomain, BecomesShorterButNotThinnerIfItsEdgesAreNearlyParallel) {
  Eigen::Matrix2d edges;
  edges << 4, 4, 0.1, -0.1;  // diagonals (8, 0) and (0, 0.2)
  shrinkToCell<2>(edges);
  EXPECT_LT((edges - (Eigen::Matrix2d() << 0.5, 0.5, 0.1, -0.1).finished()).norm(), 4 * roundOff);

  Eigen::Matrix2d box = Vec<2>(4, 0.1).asDiagonal();  // all diagonals of a box are as long
  shrinkToCell<2>(box);
  EXPECT_LT((box - Eigen::Matrix2d(Vec<2>(1, 0.025).asDiagonal())).norm(), 4 * roundOff);
}

TEST(CpdiDomain, ReachesNoFartherThanACellInThreeDimensions) {
  Eigen::Matrix3d edges;
  edges << 2, 1.5, 0.3, 0.1, -0.2, 1.2, 0.4, 0.1, -0.6;
  const Eigen::Matrix3d before = edges;
  shrinkToCell<3>(edges);
  EXPECT_LE(extentFromCentre<3>(edges), 1 + 4 * roundOff);
  EXPECT_GT(edges.determinant() / before.determinant(), 0) << "it is not turned inside out";
}

TEST(CpdiDomain, IsThatOfGimpForAnUndeformedParticleInOneDimension) {
  const Level level = grid<1>();
  Extent<1> extent;
  extent.size[0] = 0.5;
  extent.halfEdges(0, 0) = 0.25;
  // Within a cell, where the tent function is linear over the whole particle, both equal the tent function.
  const Index<1> cell{{4}};
  const Vec<1> x(level.nodePosition(0, 4) + 0.4 * level.spacing(0));
  Nodes<CubicShape<1>> cpdi, gimp;
  const auto record = [](Nodes<CubicShape<1>>& nodes) {
    return [&nodes](const Index<1>& node, double s, const Vec<1>& ds) {
      nodes.at({{node[0] - 3}}) = NodeRecord{Quad{s, ds[0], 0, 0}, Quad{}};
    };
  };
  CpdiShape<1>::Stencil(level, cell, x, extent).forEachNode(record(cpdi));
  GimpShape<1>::Stencil(level, cell, x, extent).forEachNode(record(gimp));
  for (int k = 0; k < 4; ++k)
    for (int lane = 0; lane < 2; ++lane) EXPECT_NEAR(cpdi.at({{k}})[lane], gimp.at({{k}})[lane], 10 * roundOff);
}

TEST(GimpAxis, KeepsValueAndSlopeInProportionWhereAParticleBarelyTouchesANode) {
  for (double touch = 0.25; touch > 1e-14; touch *= 0.25) {
    std::array<double, 3> s, ds;
    const double xi = 0.25 - touch;  // of size 1/2: its upper end is `touch` short of the middle of the cell
    ASSERT_EQ(GimpAxis::fill(xi, 0.5, s, ds), -1.0);
    const double overlap = 1 - (xi - 0.25 + 1);  // what of the particle lies within a cell of the node below the cell
    if (overlap <= 0) continue;
    EXPECT_NEAR(s[0] / ds[0] / (-overlap / 2), 1, 1e-14) << "S = t^2 / (2 size), dS = -t / size; touch " << touch;
  }
}

}  // namespace
}  // namespace tushar::mpm::solid
