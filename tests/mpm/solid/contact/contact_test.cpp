#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <initializer_list>
#include <utility>

#include "components/mpm/shapes/tensor_shape.hpp"
#include "components/mpm/solid/constitutive/all.hpp"
#include "components/mpm/solid/constitutive/model.hpp"
#include "components/mpm/solid/contact/friction.hpp"
#include "components/mpm/solid/explicit/tasks/exchange_momentum.hpp"
#include "components/mpm/solid/explicit/tasks/friction.hpp"
#include "tests/support/levels.hpp"

// Contact at single nodes, on plain fields.

namespace tushar::mpm::solid {
namespace {

// Sums of a few numbers of order 1.
constexpr double roundOff = 1e-14;

TEST(FrictionImpulse, LeavesBodiesThatPartAlone) {
  EXPECT_EQ(frictionImpulse<2>({{0, 1}, {1, -1}, false}, 0.5).change.norm(), 0);
}

TEST(FrictionImpulse, StopsWhatIsSlowerThanItHolds) {
  const FrictionImpulse<2> impulse = frictionImpulse<2>({{0, 1}, {0.2, 1}, false}, 0.5);
  EXPECT_LT((impulse.change + Vec<2>(0.2, 1)).norm(), roundOff) << "mu |v_n| = .5 is more than the slip of .2";
  EXPECT_EQ(impulse.heat, 0) << "what sticks makes no heat";
}

TEST(FrictionImpulse, SlowsFasterSlipByMuTimesTheApproach) {
  const FrictionImpulse<2> impulse = frictionImpulse<2>({{0, 1}, {2, 1}, false}, 0.5);
  EXPECT_LT((impulse.change - Vec<2>(-0.5, -1)).norm(), roundOff);
  EXPECT_NEAR(impulse.heat, 0.5 * 1.5, roundOff) << "the impulse of friction times the slip that it leaves";
}

TEST(FrictionImpulse, HoldsPressedBodiesTogether) {
  EXPECT_LT((frictionImpulse<2>({{0, 1}, {0, -1}, true}, 0.5).change - Vec<2>(0, 1)).norm(), roundOff);
}

/// Two bodies of unit mass, one above the other, that share the only inner node of a grid.
struct TwoBodies {
  explicit TwoBodies(const grid::Domain& domain = test::unitCells(2, 2)) : grid(domain) {
    for (auto* all : {&records[0], &records[1]}) all->assign(nodes.size(), NodeRecord{});
    for (int m : {0, 1}) {
      const auto k = static_cast<std::size_t>(m);
      surfaces[k].assign(nodes.size(), SurfaceRecord{});
      at(records[k])[lane::mass] = 1;
      setGradient(m, {0, m == 0 ? -2 : 1});
      set(m, {{3, 0.3}, {4, 1}, {5, m == 0 ? 1.25 : 0.75}});  // its volume and its position
    }
    contact.type = Contact::Type::friction;
    contact.separationFactor = 1;
  }
  template <class T>
  T& at(std::vector<T>& field) const {
    return field[nodes.offset(Index3{{1, 1, 0}})];
  }
  /// Sets numbers of a surface, each as its place and value.
  void set(int body, const std::initializer_list<std::pair<int, double>>& numbers) {
    for (const auto& [place, value] : numbers) at(surfaces[body]).numbers()[place] = value;
  }
  void setGradient(int body, const Vec<2>& gradient) { set(body, {{0, gradient[0]}, {1, gradient[1]}}); }
  /// A pressure along y.
  void press(int body) { set(body, {{7 + 3 + 1, -1}}); }
  void move(int body, const Vec<2>& v) { setLanes<2>(at(records[body]), lane::velocity, v); }
  Vec<2> velocity(int body) { return lanes<2>(at(records[body]), lane::velocity); }
  Records views() {
    Records all;
    for (auto& one : records) all.emplace_back(one.data(), nodes);
    return all;
  }
  void slide() {
    Records views;
    Surfaces sides;
    for (const std::size_t m : {std::size_t{0}, std::size_t{1}}) {
      views.emplace_back(records[m].data(), nodes);
      sides.emplace_back(surfaces[m].data(), nodes);
    }
    const FrictionHeats noHeat(sides.size());
    const data::TouchedRows all = data::TouchedRows::all(nodes);
    applyFriction<2>(grid.patches().front(), contact, 1e-3, {{&all, &all}, views}, views, sides, noHeat);
  }

  Grid grid;
  const Level& level = grid.level();
  Box nodes = level.nodes();
  Contact contact;
  std::array<std::vector<NodeRecord>, 2> records;
  std::array<std::vector<SurfaceRecord>, 2> surfaces;
};

TEST(SingleVelocity, ActsAtTheStartOfAStepUnlessItActsOnce) {
  TwoBodies bodies;
  bodies.contact.type = Contact::Type::singleVelocity;
  bodies.move(0, {0, -1});
  bodies.contact.actsTwice = false;
  exchangeMomentum<2>(bodies.grid.patches().front(), {}, {bodies.contact}, Moment::start, 0, 1e-3, bodies.views(), {});
  EXPECT_EQ(bodies.velocity(0), Vec<2>(0, -1));
  bodies.contact.actsTwice = true;
  exchangeMomentum<2>(bodies.grid.patches().front(), {}, {bodies.contact}, Moment::start, 0, 1e-3, bodies.views(), {});
  EXPECT_EQ(bodies.velocity(0), Vec<2>(0, -0.5));
  EXPECT_EQ(bodies.velocity(1), Vec<2>(0, -0.5));
}

TEST(SingleVelocity, DoesNotActWhereAMaterialExcludesIt) {
  TwoBodies bodies;
  bodies.contact.type = Contact::Type::singleVelocity;
  bodies.contact.excluded = 1;
  bodies.move(0, {0, -1});
  exchangeMomentum<2>(bodies.grid.patches().front(), {}, {bodies.contact}, Moment::start, 0, 1e-3, bodies.views(), {});
  EXPECT_EQ(bodies.velocity(0), Vec<2>(0, -1));
}

TEST(Friction, LetsBodiesNeitherPassNorLoseMomentum) {
  TwoBodies bodies;
  bodies.contact.friction = 0.25;
  bodies.move(0, {3, -1});
  bodies.move(1, {1, 1});
  bodies.slide();
  EXPECT_LT((bodies.velocity(0) - Vec<2>(2.75, 0)).norm(), roundOff);
  EXPECT_LT((bodies.velocity(1) - Vec<2>(1.25, 0)).norm(), roundOff);
}

TEST(Friction, TakesTheNormalOfTheBodyWhoseMassChangesMostToKeepMomentum) {
  TwoBodies bodies;
  bodies.contact.keepsMomentum = true;
  bodies.setGradient(1, {0.5, 0.5});  // the corner of the other
  bodies.move(0, {1, -1});
  bodies.slide();
  EXPECT_LT((bodies.velocity(0) - Vec<2>(1, -0.5)).norm(), roundOff) << "without friction nothing changes along it";
}

TEST(Friction, TakesHalfTheDifferenceOfMassGradientsForANormal) {
  TwoBodies bodies;
  bodies.setGradient(1, {2, 2});  // of (0, -2) and this: (-1, -2)
  bodies.move(0, {0, -1});
  bodies.slide();
  EXPECT_LT((bodies.velocity(0) - Vec<2>(0.2, -0.6)).norm(), roundOff);
  EXPECT_LT((bodies.velocity(1) - Vec<2>(-0.2, -0.4)).norm(), roundOff);
}

TEST(Friction, HasNoNormalWhereMassGradientsAreRoundOff) {
  for (const bool keepsMomentum : {false, true}) {
    TwoBodies bodies;
    bodies.contact.keepsMomentum = keepsMomentum;
    bodies.setGradient(0, {3e-14, 1e-14});
    bodies.setGradient(1, {-2e-14, 0});
    for (const int m : {0, 1}) bodies.press(m);
    bodies.move(0, {1, -1});
    bodies.slide();
    EXPECT_EQ(bodies.velocity(0), Vec<2>(1, -1)) << "both fill all cells around the node";
    EXPECT_EQ(bodies.velocity(1), Vec<2>(0, 0));
  }
}

TEST(Friction, TakesTheNormalOfTheFirstBodyIfMassChangesAsMuchInAnother) {
  for (const double more : {-1e-15, 1e-15}) {
    TwoBodies bodies;
    bodies.contact.keepsMomentum = true;
    bodies.setGradient(0, {0, -1});
    bodies.setGradient(1, {1 + more, 0});
    bodies.move(0, {1, -1});
    bodies.slide();
    EXPECT_LT((bodies.velocity(0) - Vec<2>(1, -0.5)).norm(), roundOff);
  }
}

TEST(Friction, TakesTheOwnNormalOfEachBodyIfItSaysSo) {
  TwoBodies bodies;
  bodies.contact.oneNormal = false;
  bodies.setGradient(1, {2, 2});  // beside (0, -2): the bodies slide along different planes
  bodies.move(0, {0, -1});
  bodies.slide();
  EXPECT_LT((bodies.velocity(0) - Vec<2>(0, -0.5)).norm(), roundOff);
  EXPECT_LT((bodies.velocity(1) - Vec<2>(-0.25, -0.25)).norm(), roundOff);
}

TEST(Friction, TakesNormalsPerCellIfItSaysSo) {
  grid::Domain domain = test::unitCells(2, 2);
  domain.upper = {2, 6, 0};  // cells of 1 by 3 m
  TwoBodies bodies(domain);
  bodies.contact.normalsInCells = true;
  bodies.setGradient(0, {-3, -1});
  bodies.setGradient(1, {3, 1});
  bodies.move(0, {-1, -1});
  bodies.slide();
  EXPECT_LT((bodies.velocity(0) - Vec<2>(-0.5, -0.5)).norm(), roundOff) << "straight through";
}

TEST(Friction, HoldsABodyThatIsPressedAloneUnlessItKeepsMomentum) {
  for (const bool keepsMomentum : {false, true}) {
    TwoBodies bodies;
    bodies.contact.keepsMomentum = keepsMomentum;
    bodies.move(0, {0, 1});
    bodies.press(0);
    bodies.slide();
    EXPECT_LT((bodies.velocity(0) - Vec<2>(0, keepsMomentum ? 1 : 0.5)).norm(), roundOff);
    EXPECT_LT(bodies.velocity(1).norm(), roundOff);
  }
}

TEST(Friction, LetsBodiesPartUnlessTheyArePressed) {
  TwoBodies bodies;
  bodies.move(0, {0, 1});
  bodies.slide();
  EXPECT_EQ(bodies.velocity(0), Vec<2>(0, 1));
  for (const int m : {0, 1}) bodies.press(m);
  bodies.slide();
  EXPECT_LT((bodies.velocity(0) - Vec<2>(0, 0.5)).norm(), roundOff);
}

TEST(Friction, LetsPressedBodiesPartWhereOnlyApproachCounts) {
  TwoBodies bodies;
  bodies.contact.onlyOnApproach = true;
  for (const int m : {0, 1}) bodies.press(m);
  bodies.move(0, {0, 1});
  bodies.slide();
  EXPECT_EQ(bodies.velocity(0), Vec<2>(0, 1));
}

TEST(Friction, DoesNotActBetweenBodiesThatAreFarApart) {
  TwoBodies bodies;
  bodies.contact.separationFactor = 0.4;  // of a cell of 1 m; the bodies are 0.5 m apart
  bodies.move(0, {0, -1});
  bodies.slide();
  EXPECT_EQ(bodies.velocity(0), Vec<2>(0, -1));
}

TEST(Friction, DoesNotActWhereTheVolumeIsNotFilled) {
  TwoBodies bodies;
  bodies.contact.volumeConstraint = 0.7;  // 0.6 of the cell are filled
  bodies.move(0, {0, -1});
  bodies.slide();
  EXPECT_EQ(bodies.velocity(0), Vec<2>(0, -1));
}

TEST(Surface, PointsOutOfTheBody) {
  const Grid grid(test::unitCells(2, 2));
  const Level& level = grid.level();
  data::ParticleSet set;
  set.reset(grid.patches().front(), LinearShape<2>::reach);
  set.at(Index3{{0, 0, 0}}) = {0, 1};
  set.setOwned(1);
  const std::vector<Vec<2>> x{{0.5, 0.25}};
  const std::vector<double> mass{3};
  const std::vector<Matrix3> deformation{Matrix3::Identity()}, stress{Matrix3::Identity()};
  Material material;
  material.density = 2;
  material.model = std::make_shared<ModelOf<IdealGas>>(IdealGas{});
  const Box nodes = level.nodes(), cells = level.cells();
  std::vector<SurfaceRecord> surface(nodes.size()), other(nodes.size());
  std::vector<NodeRecord> record(nodes.size());
  const std::size_t corner = nodes.offset(Index3{{1, 1, 0}});
  record[corner][lane::mass] = 1;
  const auto of = [&](std::vector<SurfaceRecord>& to, const data::ParticleSet& particles) {
    return SurfaceSources<2>{.x = {x.data(), particles, cells},
                             .size = {},
                             .mass = {mass.data(), particles, cells},
                             .deformation = {deformation.data(), particles, cells},
                             .particleStress = ParticleView<const Matrix3>{stress.data(), particles, cells},
                             .surface = {to.data(), nodes}};
  };
  computeSurface<LinearShape<2>>(grid.patches().front(), {material, material}, Vec3::Ones(),
                                 {{record.data(), nodes}, {record.data(), nodes}}, {of(surface, set), of(other, set)});
  for (const SurfaceRecord& sum : {surface[corner], other[corner]}) {
    EXPECT_LT((sum.massGradient<2>() - Vec<2>(3 * 0.25, 3 * 0.5)).norm(), roundOff);
    EXPECT_LT((sum.massPosition<2>() - 3 * 0.5 * 0.25 * Vec<2>(0.5, 0.25)).norm(), roundOff);
    EXPECT_NEAR(sum.volume(), 1.5 * 0.5 * 0.25, roundOff);
    for (const int i : {0, 1, 2})
      for (const int j : {0, 1, 2}) EXPECT_NEAR(sum.stress(i, j), i == j ? 0.5 * 0.25 : 0, roundOff);
  }
}

TEST(Specified, MovesTheOthersAlongItsDirectionsOnly) {
  TwoBodies bodies;
  bodies.contact.type = Contact::Type::specified;
  bodies.contact.direction = {false, true, false};
  bodies.move(0, {5, -1});
  bodies.move(1, {1, 0});
  const Records views{{bodies.records[0].data(), bodies.nodes}, {bodies.records[1].data(), bodies.nodes}};
  followMaster<2>(bodies.grid.patches().front(), bodies.contact, 0, 1e-3, views);
  EXPECT_EQ(bodies.velocity(1), Vec<2>(1, -1));
  EXPECT_EQ(bodies.velocity(0), Vec<2>(5, -1));
}

TEST(Specified, MovesNothingWhereRoundingLeavesATraceOfTheMaster) {
  TwoBodies bodies;
  bodies.contact.type = Contact::Type::specified;
  bodies.contact.direction = {true, true, true};
  bodies.at(bodies.records[0])[lane::mass] = 1e-30;
  bodies.move(0, {5, -1});
  followMaster<2>(bodies.grid.patches().front(), bodies.contact, 0, 1e-3, bodies.views());
  EXPECT_EQ(bodies.velocity(1), Vec<2>(0, 0));
}

TEST(Specified, MovesNothingWhereTheExcludedMaterialIs) {
  TwoBodies bodies;
  bodies.contact.type = Contact::Type::specified;
  bodies.contact.direction = {true, true, true};
  bodies.contact.excluded = 1;
  bodies.move(0, {5, -1});
  const Records views{{bodies.records[0].data(), bodies.nodes}, {bodies.records[1].data(), bodies.nodes}};
  followMaster<2>(bodies.grid.patches().front(), bodies.contact, 0, 1e-3, views);
  EXPECT_EQ(bodies.velocity(1), Vec<2>(0, 0));
}

TEST(Specified, FeelsTheForceThatItHoldsTheOthersWith) {
  TwoBodies bodies;
  bodies.contact.type = Contact::Type::specified;
  bodies.move(1, {0, 0.02});  // what a force of 20 N and gravity make of rest in a millisecond
  const Records views{{bodies.records[0].data(), bodies.nodes}, {bodies.records[1].data(), bodies.nodes}};
  VectorSum reaction;
  sumReaction<2>(bodies.grid.patches().front(), bodies.contact, {Vec3(0, 5, 0), 0}, 1e-3, views, reaction);
  EXPECT_NEAR(reaction.y.total(), -15, 1e-12);
}

TEST(Specified, TurnsTheOthersWithIt) {
  TwoBodies bodies;
  bodies.contact.type = Contact::Type::specified;
  bodies.contact.direction = {true, true, true};
  bodies.contact.profile = {{0, Vec3(1, 0, 0)}, {1, Vec3(1, 0, 0)}};
  bodies.contact.centres = {{0, Vec3(1, 0, 0)}, {1, Vec3(1, 0, 0)}};
  bodies.contact.angularVelocity = {{0, Vec3(0, 0, 0)}, {1, Vec3(0, 0, 4)}};
  const Records views = bodies.views();
  const double dt = 1e-8;
  followMaster<2>(bodies.grid.patches().front(), bodies.contact, 0.5, dt, views);
  for (const int body : {0, 1})  // at (1, 1), a metre above the centre
    EXPECT_LT((bodies.velocity(body) - Vec<2>(1 - 2, 0)).norm(), 2 * 2 * dt) << "omega^2 r dt / 2 is the chord's";
}

TEST(Motion, KeepsPointsOnTheirCircleInAnyTime) {
  for (int axis = 0; axis < 3; ++axis) {
    Motion motion{.velocity = Vec3(1, 2, 3), .centre = Vec3(0.3, -0.2, 0.1), .angularVelocity = 7 * Vec3::Unit(axis)};
    const Vec3 point(1, 2, -1), before = point - motion.centre;
    const double dt = 0.2;
    const Vec3 after = before + dt * (motion.at(point, dt) - motion.velocity);
    const Eigen::AngleAxisd turn(7 * dt, Vec3::Unit(axis));
    EXPECT_LT((after - turn * before).norm(), 10 * roundOff) << "axis " << axis;
  }
}

TEST(Motion, AboutAnObliqueAxisIsItsVelocity) {
  const Motion motion{.velocity = Vec3(1, 0, 0), .centre = Vec3::Zero(), .angularVelocity = Vec3(1, 1, 1)};
  EXPECT_LT((motion.at(Vec3(1, 0, 0), 1) - Vec3(1, 1, -1)).norm(), roundOff);
  EXPECT_EQ((Motion{.velocity = Vec3(1, 2, 3)}.at(Vec3(9, 9, 9), 1)), Vec3(1, 2, 3));
}

TEST(Specified, GoesThroughItsProfileAndThenStops) {
  Contact contact;
  contact.profile = {{1, Vec3(0, 0, 0)}, {3, Vec3(4, 0, 0)}};
  contact.stopTime = 5;
  contact.velocityAfterStop = Vec3(0, 7, 0);
  EXPECT_EQ(contact.prescribedVelocity(0)->x(), 0);
  EXPECT_EQ(contact.prescribedVelocity(2)->x(), 2);
  EXPECT_EQ(contact.prescribedVelocity(4)->x(), 4);
  EXPECT_EQ(contact.prescribedVelocity(6)->y(), 7);
}

}  // namespace
}  // namespace tushar::mpm::solid
