#include "tests/mpmice/fields.hpp"

#include "components/mpmice/tasks/wall_force.hpp"

namespace tushar::mpmice {

namespace {

template <class T>
class WallForceAlongAxes : public testing::Test {};
TYPED_TEST_SUITE(WallForceAlongAxes, AllAxes);

namespace lane = mpm::solid::lane;
using mpm::solid::NodeRecord;

/// A body in the middle of a grid of 6 cells along each axis: two materials at its nodes, with one velocity.
template <int D>
struct Walled {
  Walled() : gas(level().cells()), below(level().cells(), Vec<D>::Zero()), above(below) {
    forEach<D>(level().cells(), [&](const Index<D>& cell) {
      bool isBody = true;
      for (int d = 0; d < D; ++d) isBody &= cell[d] == 2 || cell[d] == 3;
      if (!isBody) return;
      gas.free.cells()[cell] = 0;
      gas.density.cells()[cell] = 0;
    });
    for (int m = 0; m < 2; ++m) {
      records.emplace_back(level().nodes(), NodeRecord{});
      forces.emplace_back(level().nodes(), Vec<D>::Zero());
    }
    int number = 0;
    forEach<D>(level().nodes(), [&](const Index<D>& node) {
      for (int d = 0; d < D; ++d)
        if (node[d] < 2 || node[d] > 4) return;
      for (int m = 0; m < 2; ++m) {
        NodeRecord& record = records[m].nodes()[node];
        record[lane::mass] = 0.1 + wild(++number);
        mpm::solid::setLanes<D>(record, lane::velocity, Vec<D>::Constant(0.7));
      }
    });
  }
  const Level& level() const { return grid.level(); }
  typename BodiesAtNodes<D>::Records seen() const {
    typename BodiesAtNodes<D>::Records views;
    for (const auto& field : records) views.push_back({field.seenNodes()});
    return views;
  }

  Grid grid{euler::closedBox(D, 6)};
  GasFields<D> gas;
  Field<Vec<D>> below, above;
  std::vector<Field<NodeRecord>> records;
  std::vector<Field<Vec<D>>> forces;
};

/// Computes wall pressures and their force; returns the total force.
template <int D>
Vec3 forceOf(Walled<D>& walled, const Settings& settings) {
  VectorSum sum;
  for (const Patch& patch : walled.grid.patches()) {
    std::vector<NodeView<Vec<D>>> forces;
    for (auto& field : walled.forces) forces.push_back(field.nodes());
    computeWallPressure<D>(patch, {}, settings, walled.gas.gas(), walled.seen(), {},
                           {walled.below.cells(), walled.above.cells()});
    addWallForce<D>(patch, {}, settings, walled.gas.gas(), {walled.below.seen(), walled.above.seen()}, walled.seen(),
                    sum, forces);
  }
  const std::vector<double> values = sum.values();
  return {values[0], values[1], values[2]};
}

}  // namespace

TYPED_TEST(WallForceAlongAxes, SeesTheVelocityAndTheMassOfAllBodiesAtAFace) {
  constexpr int D = TypeParam::value;
  const Walled<D> walled;
  const auto views = walled.seen();
  const BodiesAtNodes<D> bodies(walled.level(), views);
  const Index<D> face = Index<D>::filled(2);
  EXPECT_NEAR((bodies.velocityAt(face, 0, lane::velocity) - Vec<D>::Constant(0.7)).norm(), 0, 1e-15);
  EXPECT_EQ(bodies.velocityAt(Index<D>::filled(0), 0, lane::velocity), Vec<D>(Vec<D>::Zero()));
  double mass = 0;
  forEach<D>(bodies.nodesAt(face, 0), [&](const Index<D>& node) {
    for (const auto& body : views) mass += body.records[node][lane::mass];
  });
  EXPECT_DOUBLE_EQ(bodies.massAt(face, 0), mass);
  EXPECT_EQ(bodies.nodesAt(face, 0).size(), 3 * std::pow(2, D - 1));
  EXPECT_EQ(bodies.nodesAt(Index<D>::filled(0), 0).size(), 2 * std::pow(2, D - 1)) << "at the side of the grid";
}

TYPED_TEST(WallForceAlongAxes, BelongsToTheBodiesThatCoverTheFace) {
  constexpr int D = TypeParam::value;
  Walled<D> walled;
  std::vector<Field<double>> free;
  std::vector<Field<Vec<D>>> coverage;
  for (int m = 0; m < 2; ++m) {
    free.emplace_back(walled.level().cells(), 1);
    coverage.emplace_back(walled.level().cells(), Vec<D>::Zero());
    for (NodeRecord& one : walled.records[m].values) {
      one[lane::mass] *= m == 1 ? 100 : 1;
      mpm::solid::setLanes<D>(one, lane::velocity, Vec<D>::Constant(m == 1 ? -8 : 0.7));
    }
  }
  const Index<D> face = Index<D>::filled(2);
  const auto views = [&] {
    auto each = walled.seen();
    for (int m = 0; m < 2; ++m) {
      each[m].free = free[m].seen();
      each[m].coverage = coverage[m].seen();
    }
    return each;
  };
  const auto velocity = [&] {
    const auto seen = views();
    return BodiesAtNodes<D>(walled.level(), seen).velocityAt(face, 0, lane::velocity)[0];
  };
  EXPECT_LT(velocity(), -7) << "by mass, if neither is there";
  free[0].cells()[face] = 0.5;
  EXPECT_NEAR(velocity(), 0.7, 1e-14) << "the first is beside the face, the heavy one only near it";
  coverage[0].cells()[face][0] = 0.5;
  free[1].cells()[face - Index<D>::unit(0)] = 0.5;
  EXPECT_NEAR(velocity(), 0.7, 1e-14) << "the heavy one is beside the face, but does not cover it";
  coverage[1].cells()[face][0] = 0.5;
  EXPECT_NEAR(velocity(), 0.5 * (0.7 - 8), 1e-13);

  const auto seen = views();
  const BodiesAtNodes<D> bodies(walled.level(), seen);
  EXPECT_EQ(bodies.coverageAt(face, 0), 1);
  std::array<double, 2> shares{};
  double perMass = 0;
  bodies.distribute(face, 0, [&](std::size_t body, const Index<D>& node, double share) {
    shares[body] += share;
    perMass += share * share / seen[body].records[node][lane::mass];
  });
  EXPECT_NEAR(shares[0], 0.5, 1e-14);
  EXPECT_NEAR(shares[1], 0.5, 1e-14);
  EXPECT_NEAR(bodies.massAt(face, 0) * perMass, 1, 1e-13) << "acceleration of velocityAt";
}

TYPED_TEST(WallForceAlongAxes, AtASymmetryPlaneSeesABodyThatDoesNotMoveThroughIt) {
  constexpr int D = TypeParam::value;
  Walled<D> walled;
  for (auto& records : walled.records)
    for (NodeRecord& one : records.values) {
      one[lane::mass] = 1;
      mpm::solid::setLanes<D>(one, lane::velocity, Vec<D>::Constant(0.7));
    }
  const auto views = walled.seen();
  const BodiesAtNodes<D> bodies(walled.level(), views);
  const int last = walled.level().cells().upper[0];
  for (const int plane : {0, last}) {
    Index<D> face = Index<D>::filled(2);
    face[0] = plane;
    Vec<D> along = Vec<D>::Constant(0.7);
    along[0] = 0;
    EXPECT_NEAR((bodies.velocityAt(face, 0, lane::velocity) - along).norm(), 0, 1e-15);
    EXPECT_EQ(bodies.speedsAt(face, 0).after, 0);
    // Two layers of nodes here, and as many beyond; the plane itself has the other half of its mass there.
    EXPECT_DOUBLE_EQ(bodies.massAt(face, 0), static_cast<double>(4 * views.size()) * std::pow(2, D - 1));
  }
}

TYPED_TEST(WallForceAlongAxes, IsNoneInAUniformGasThatMovesWithTheBody) {
  constexpr int D = TypeParam::value;
  Walled<D> walled;
  for (std::size_t k = 0; k < walled.gas.momentum.values.size(); ++k) {
    walled.gas.momentum.values[k].setConstant(0.7 * walled.gas.density.values[k]);
    walled.gas.energy.values[k] = 2.5 + 0.5 * D * 0.49;
  }
  EXPECT_NEAR(forceOf(walled, {}).norm(), 0, 1e-14);
}

TYPED_TEST(WallForceAlongAxes, GoesToTheNodesWholly) {
  constexpr int D = TypeParam::value;
  Walled<D> walled;
  for (std::size_t k = 0; k < walled.gas.energy.values.size(); ++k) walled.gas.energy.values[k] = 1 + 3 * wild(k);
  const Vec3 whole = forceOf(walled, {});
  EXPECT_GT(whole.norm(), 1e-3);
  Vec<D> atNodes = Vec<D>::Zero();
  for (const auto& field : walled.forces)
    for (const Vec<D>& force : field.values) atNodes += force;
  EXPECT_NEAR((walled.level().template expandDirection<D>(atNodes) - whole).norm(), 0, 1e-13);
}

TYPED_TEST(WallForceAlongAxes, IsThatOfThePressureWhateverTheReferenceIfGasIsAllAround) {
  constexpr int D = TypeParam::value;
  Walled<D> walled;
  for (auto& record : walled.records)  // at rest
    for (NodeRecord& one : record.values) mpm::solid::setLanes<D>(one, lane::velocity, Vec<D>::Zero());
  // Pressure 3 in the cells below the body along the first axis, 1 elsewhere.
  forEach<D>(walled.level().cells(), [&](const Index<D>& cell) {
    if (cell[0] < 2) walled.gas.energy.cells()[cell] = 7.5;
  });
  const double side = std::pow(2.0 / 6, D - 1);
  EXPECT_NEAR((forceOf(walled, {}) - Vec3(2 * side, 0, 0)).norm(), 0, 1e-14);
  Settings above;
  above.referencePressure = 1;
  EXPECT_NEAR((forceOf(walled, above) - Vec3(2 * side, 0, 0)).norm(), 0, 1e-14);
}

TEST(WallForce, IsPressureAndRecoilWhereNewGasLeavesAtTheSpeedOfTheOld) {
  constexpr int D = 1;
  Walled<D> walled;
  for (auto& record : walled.records)
    for (NodeRecord& one : record.values) mpm::solid::setLanes<D>(one, lane::velocity, Vec<D>::Zero());
  Field<Vec<D>> speed(walled.level().cells(), Vec<D>::Zero()), recoil(speed);
  // The gas below the body flows away from it along the first axis with .3, as does the gas that leaves the body.
  forEach<D>(walled.level().cells(), [&](const Index<D>& cell) {
    if (cell[0] == 1) {
      walled.gas.momentum.cells()[cell][0] = -0.3;
      walled.gas.energy.cells()[cell] = 2.5 + 0.5 * 0.09;
    }
    if (cell[0] != 2) return;
    speed.cells()[cell][0] = 0.3;
    recoil.cells()[cell][0] = 0.25;
  });
  const Blowing<D> blowing{speed.seen(), recoil.seen()};
  for (const Patch& patch : walled.grid.patches())
    computeWallPressure<D>(patch, {}, {}, walled.gas.gas(), walled.seen(), blowing,
                           {walled.below.cells(), walled.above.cells()});
  Index<D> beside = Index<D>::filled(2);
  beside[0] = 1;
  EXPECT_NEAR(walled.above.seen()[beside][0], 1 + 0.25, 1e-14);
  beside[0] = 4;
  EXPECT_NEAR(walled.below.seen()[beside][0], 1, 1e-14) << "the other side does not burn";
}

}  // namespace tushar::mpmice
