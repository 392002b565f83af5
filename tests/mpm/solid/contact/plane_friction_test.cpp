#include "components/mpm/solid/contact/plane_friction.hpp"

#include <gtest/gtest.h>

#include "components/mpm/shapes/tensor_shape.hpp"
#include "components/mpm/solid/constitutive/all.hpp"
#include "components/mpm/solid/explicit/tasks/separate_bodies.hpp"
#include "tests/support/levels.hpp"

// Friction along planes that separate the particles of bodies, on plain fields.

namespace tushar::mpm::solid {
namespace {

// Sums of a few numbers of order 1.
constexpr double roundOff = 1e-14;

TEST(SeparatingNormal, IsThatOfTheMirrorBetweenTwoBodies) {
  const Vec<2> normal(0.6, 0.8), along(-0.8, 0.6);
  std::vector<SidedParticle<2>> particles;
  for (const double s : {-0.3, -0.1, 0.1, 0.3})
    for (const double away : {0.1, 0.3}) {
      particles.push_back({s * along - away * normal, false});
      particles.push_back({s * along + away * normal, true});
    }
  // The tolerance of the regression is 1e-7 in the cosine between steps.
  EXPECT_LT((separatingNormal<2>(particles, 0.5) - normal).norm(), 1e-3);
  for (auto& particle : particles) particle.isOther = !particle.isOther;
  EXPECT_LT((separatingNormal<2>(particles, 0.5) + normal).norm(), 1e-3);
}

TEST(SeparatingNormal, DoesNotDependOnWhereTheNodeIs) {
  std::vector<SidedParticle<2>> here, there;
  for (const auto& [x, y, other] : {std::tuple{0.1, -0.2, false},
                                    {0.3, -0.1, false},
                                    {-0.1, -0.1, false},
                                    {0.2, 0.2, true},
                                    {-0.2, 0.1, true},
                                    {0.0, 0.3, true}}) {
    here.push_back({{x, y}, other});
    there.push_back({{x + 0.2, y - 0.3}, other});
  }
  EXPECT_LT((separatingNormal<2>(here, 0.5) - separatingNormal<2>(there, 0.5)).norm(), 1e-9);
}

/// Two bodies of 2 and 1 kg that share the only inner node of a grid; the second is above the first.
struct TwoBodies {
  TwoBodies() : grid(test::unitCells(2, 2)) {
    for (const std::size_t m : {std::size_t{0}, std::size_t{1}}) {
      records[m].assign(nodes.size(), NodeRecord{});
      normal[m].assign(nodes.size(), Vec<2>::Zero());
      prominence[m].assign(nodes.size(), noProminence);
      color[m].assign(nodes.size(), 0.0);
    }
    records[0][centre][lane::mass] = 2;
    records[1][centre][lane::mass] = 1;
    normal[0][centre] = Vec<2>(0, 1);
    prominence[0][centre] = 1.01;
    prominence[1][centre] = 0.99;
    contact.type = Contact::Type::planeFriction;
  }
  void move(std::size_t body, const Vec<2>& v) { setLanes<2>(records[body][centre], lane::velocity, v); }
  Vec<2> velocity(std::size_t body) const { return lanes<2>(records[body][centre], lane::velocity); }
  Records views() {
    Records all;
    for (auto& one : records) all.emplace_back(one.data(), nodes);
    return all;
  }
  SeparatingPlanes<2> planes() const {
    SeparatingPlanes<2> all;
    for (const std::size_t m : {std::size_t{0}, std::size_t{1}})
      all.push_back({NodeView<const Vec<2>>(normal[m].data(), nodes),
                     NodeView<const double>(prominence[m].data(), nodes),
                     NodeView<const double>(color[m].data(), nodes)});
    return all;
  }
  MeetingBodies<2> meeting() {
    const data::TouchedRows all = data::TouchedRows::all(nodes);
    return {{&all, &all}, views()};
  }
  void slide() { slideAlongPlanes<2>(level, contact, views(), planes(), meeting()); }

  Grid grid;
  const Level& level = grid.level();
  Box nodes = level.nodes();
  std::size_t centre = nodes.offset(Index3{{1, 1, 0}});
  Contact contact;
  std::array<std::vector<NodeRecord>, 2> records;
  std::array<std::vector<Vec<2>>, 2> normal;
  std::array<std::vector<double>, 2> prominence, color;
};

TEST(PlaneFriction, StopsTheApproachSlowsTheSlipAndKeepsMomentum) {
  TwoBodies bodies;
  bodies.contact.friction = 0.25;
  bodies.move(1, {9, -3});  // the centre of mass: (3, -1)
  bodies.slide();
  EXPECT_LT((bodies.velocity(1) - Vec<2>(9 - 0.25 * 2, -1)).norm(), roundOff);
  EXPECT_LT((bodies.velocity(0) - Vec<2>(0.25, -1)).norm(), roundOff);
}

TEST(PlaneFriction, SticksWhereItHoldsTheSlip) {
  TwoBodies bodies;
  bodies.contact.friction = 5;
  bodies.move(1, {9, -3});
  bodies.slide();
  for (const std::size_t body : {std::size_t{0}, std::size_t{1}})
    EXPECT_LT((bodies.velocity(body) - Vec<2>(3, -1)).norm(), roundOff);
}

TEST(PlaneFriction, LeavesBodiesAloneThatPartOrDoNotOverlap) {
  TwoBodies bodies;
  bodies.move(1, {9, 3});
  bodies.slide();
  EXPECT_EQ(bodies.velocity(1), Vec<2>(9, 3)) << "they part";
  bodies.move(1, {9, -3});
  bodies.prominence[1][bodies.centre] = 1.02;
  bodies.slide();
  EXPECT_EQ(bodies.velocity(1), Vec<2>(9, -3)) << "a gap is between them";
}

TEST(PlaneFriction, TakesFacesThatMeetExceptForRoundOffAsTouching) {
  for (const double gap : {-1e-15, 0.0, 1e-15}) {
    TwoBodies bodies;
    bodies.move(1, {9, -3});
    bodies.prominence[1][bodies.centre] = bodies.prominence[0][bodies.centre] + gap;
    bodies.slide();
    EXPECT_LT((bodies.velocity(1) - Vec<2>(9, -1)).norm(), roundOff) << gap;
  }
}

TEST(PlaneFriction, TakesMuByTheColorOfTheMaster) {
  TwoBodies bodies;
  bodies.contact.frictionOfColor = {{1, 0.1}, {3, 0.5}};
  bodies.contact.master = 1;
  for (const auto& [color, mu] : {std::pair{0.0, 0.1}, {2.0, 0.3}, {9.0, 0.5}}) {
    bodies.color[1][bodies.centre] = color;
    bodies.move(0, {0, 0});
    bodies.move(1, {9, -3});
    bodies.slide();
    EXPECT_NEAR(bodies.velocity(1)[0], 9 - mu * 2, roundOff);
  }
}

TEST(SpecifiedFriction, SlidesOnAMasterThatMovesAsTold) {
  TwoBodies bodies;
  bodies.contact.type = Contact::Type::specifiedFriction;
  bodies.contact.friction = 0.5;
  bodies.contact.profile = {{0, Vec3(0, 1, 0)}, {1, Vec3(0, 1, 0)}};
  bodies.move(1, {4, -1});
  slideOnMaster<2>(bodies.grid.patches().front(), bodies.contact, 0, 1e-3, bodies.views(), bodies.planes(),
                   bodies.meeting());
  EXPECT_EQ(bodies.velocity(0), Vec<2>(0, 1));
  EXPECT_LT((bodies.velocity(1) - Vec<2>(4 - 0.5 * 2, 1)).norm(), roundOff);
}

TEST(SpecifiedFriction, FeelsTheForceOfThoseThatItStops) {
  TwoBodies bodies;
  bodies.contact.type = Contact::Type::specifiedFriction;
  bodies.move(1, {0, -0.02});  // what 20 N make of rest in a millisecond
  VectorSum reaction;
  sumSlidingReaction<2>(bodies.grid.patches().front(), bodies.contact, {Vec3::Zero(), 0}, 0, 1e-3, bodies.views(),
                        bodies.planes(), bodies.meeting(), reaction);
  EXPECT_NEAR(reaction.y.total(), 20, 1e-12);
}

constexpr std::array<std::size_t, 2> both{0, 1};

TEST(Precedence, IsOfTheFirstBodyIfAnotherIsAsHeavy) {
  for (const double more : {-1e-15, 1e-15}) {
    TwoBodies bodies;
    bodies.records[1][bodies.centre][lane::mass] = 2 * (1 + more);
    std::vector<NodeView<const NodeRecord>> records;
    for (const auto& one : bodies.records) records.emplace_back(one.data(), bodies.nodes);
    const std::vector<Material> materials(2);
    EXPECT_EQ((Precedence(materials, {}).leader<2>(records, both, Index<2>{{1, 1}})), 0) << more;
  }
}

TEST(Precedence, IsOfTheHeaviestUnlessOneIsRigidOrMayNot) {
  TwoBodies bodies;
  std::vector<Material> materials(2);
  std::vector<NodeView<const NodeRecord>> records;
  for (const auto& one : bodies.records) records.emplace_back(one.data(), bodies.nodes);
  const Index<2> node{{1, 1}};
  const auto leader = [&](const std::vector<Contact>& contacts = {}) {
    return Precedence(materials, contacts).leader<2>(records, both, node);
  };
  EXPECT_EQ(leader(), 0);
  materials[1].isRigid = true;
  EXPECT_EQ(leader(), 1);
  materials[1].mayLeadContact = false;
  EXPECT_EQ(leader(), -1) << "one alone meets nobody";
  materials[1] = Material{};
  bodies.contact.type = Contact::Type::specifiedFriction;
  bodies.contact.master = 1;
  EXPECT_EQ(leader({bodies.contact}), 1) << "masters are rigid";
  EXPECT_EQ((Precedence(materials, {}).leader<2>(records, both, Index<2>{{0, 0}})), -1);
  EXPECT_EQ((Precedence(materials, {}).leader<2>(records, std::span(both).first(1), node)), -1)
      << "the other has no particles";
}

}  // namespace
}  // namespace tushar::mpm::solid
