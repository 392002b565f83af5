#include <gtest/gtest.h>

#include <type_traits>

#include "components/mpm/shapes/cpdi_shape.hpp"
#include "components/mpm/solid/transfer/stencil_groups.hpp"
#include "tests/mpm/shapes/somewhere.hpp"

namespace tushar::mpm::solid {
namespace {

template <class Shape>
class EveryGroup : public testing::Test {};
using Shapes = testing::Types<LinearShape<1>, LinearShape<2>, LinearShape<3>, GimpShape<1>, GimpShape<2>, GimpShape<3>,
                              CpdiShape<1>, CpdiShape<2>, CpdiShape<3>, CubicShape<2>, AxisymmetricLinearShape<2>,
                              AxisymmetricGimpShape<1>, AxisymmetricGimpShape<2>>;
TYPED_TEST_SUITE(EveryGroup, Shapes);

/// The stencils of the particles as a group; of the first particle only, if shape functions deform.
template <class Shape>
auto groupOf(const InOneCell<Shape>& particles, const Level& level) {
  if constexpr (Shape::deforms)
    return GroupOfOne(typename Shape::Stencil(level, particles.cell, particles.x[0], particles.extent));
  else
    return particles.stencils(level);
}

/// Numbers on the nodes of a box that contains only some nodes of most stencils in a cell.
template <int D>
struct NodesNear {
  Box box{{}, Index3::filled(1)}, stored = box;
  std::vector<double> numbers;
  NodeView<double> view;

  explicit NodesNear(const Index<D>& cell) : view(nullptr, box) {
    for (int d = 0; d < D; ++d) {
      box.lower[d] = cell[d];
      box.upper[d] = cell[d] + 2;
      stored.lower[d] = cell[d] - 2;
      stored.upper[d] = cell[d] + 4;
    }
    numbers.assign(static_cast<std::size_t>(stored.size()), 0.0);
    view = NodeView<double>(numbers.data(), stored, box);
  }
};

TYPED_TEST(EveryGroup, GivesNodesTheSameBitsAsItsParticlesAlone) {
  constexpr int D = TypeParam::dimension;
  const Level level = grid<D>();
  std::mt19937 random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const InOneCell<TypeParam> particles(level, random);
    const auto group = groupOf<TypeParam>(particles, level);
    using Group = std::remove_const_t<decltype(group)>;
    const int count = TypeParam::deforms ? 1 : particles.count;
    const Lanes weight = Lanes::of([](int lane) { return lane + 0.3; });
    NodeShares<Group> shares;
    group.forEachNode([&](std::size_t at, Lanes s, const std::array<Lanes, D>& gradient) {
      shares[at] = s * weight + gradient[D - 1];
      if constexpr (TypeParam::axisymmetric) shares[at] += group.hoop(at);
    });
    const NodesNear<D> together(particles.cell), alone(particles.cell);
    addShares(group, count, together.view, shares);
    for (int k = 0; k < count; ++k) {
      const typename TypeParam::Stencil stencil(level, particles.cell, particles.x[k], particles.extent);
      forEachNodeWithin(stencil, alone.box, [&](const Index<D>& node, double s, const Vec<D>& gradient) {
        double share = s * weight[k] + gradient[D - 1];
        if constexpr (TypeParam::axisymmetric) share += hoopOf(stencil, node);
        alone.view[node] += share;
      });
    }
    EXPECT_EQ(together.numbers, alone.numbers);
  }
}

TYPED_TEST(EveryGroup, LoadsTheValuesOfItsNodes) {
  constexpr int D = TypeParam::dimension;
  const Level level = grid<D>();
  std::mt19937 random(9);
  for (int trial = 0; trial < 50; ++trial) {
    const InOneCell<TypeParam> particles(level, random);
    const auto group = groupOf<TypeParam>(particles, level);
    NodesNear<D> nodes(particles.cell);
    for (std::size_t k = 0; k < nodes.numbers.size(); ++k) nodes.numbers[k] = static_cast<double>(k);
    const NodeView<const double> view(nodes.numbers.data(), nodes.stored, nodes.stored);
    const auto values = nodeValues(group, view);
    for (int k = 0; k < (TypeParam::deforms ? 1 : particles.count); ++k)
      for (std::size_t at = 0; at < values.size(); ++at)
        EXPECT_EQ(values[at][k], view[nodeOf<std::remove_const_t<decltype(group)>>(group.first(k), at)]);
  }
}

}  // namespace
}  // namespace tushar::mpm::solid
