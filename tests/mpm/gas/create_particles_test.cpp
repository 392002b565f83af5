#include "components/mpm/gas/tasks/create_particles.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "components/mpm/gas/tasks/diagnose.hpp"
#include "core/input/document.hpp"
#include "core/input/geometry.hpp"
#include "tests/support/run.hpp"

namespace tushar::mpm::gas {

namespace {

input::PiecePtr box(const std::string& min, const std::string& max) {
  input::Diagnostics diagnostics;
  static std::vector<std::unique_ptr<input::Document>> kept;
  kept.push_back(std::make_unique<input::Document>(input::Document::parse(
      "<Uintah_specification><o><box><min>" + min + "</min><max>" + max + "</max></box></o></Uintah_specification>",
      "scene", diagnostics)));
  return input::readGeometry(*kept.back()->root().child("o"), diagnostics);
}

Gas gasOf(const std::vector<std::pair<std::string, std::string>>& boxes, int perCell) {
  Gas gas;
  gas.name = "gas";
  for (const auto& [min, max] : boxes) {
    GasObject object;
    object.shape = box(min, max);
    object.particlesPerCell = {{perCell, 1, 1}};
    object.density = *input::Expression::parse("2+x");
    object.pressure = *input::Expression::parse("1");
    object.velocity = *input::VectorExpression::parse("[x,0,0]");
    gas.objects.push_back(object);
  }
  return gas;
}

/// Returns the positions, by id, of the particles that createParticles makes on all patches.
std::map<ParticleId, double> made(const Gas& gas, int patches) {
  test::Runner run(test::domain({{10, 1, 1}}, {{patches, 1, 1}}));
  const std::vector<Gas> materials{gas};
  TaskList list;
  list.newParticles("create", createParticles<1>, materials, creates(p::x<1>), creates(p::velocity<1>),
                    creates(p::density), creates(p::internalEnergy));
  tasks::TaskGraph graph = run.compile(list, {"p.x", "p.velocity", "p.density", "p.internalEnergy", "p.particleID"});
  run.step(graph);
  std::map<ParticleId, double> positions;
  for (int patch = 0; patch < patches; ++patch) {
    const auto read = [&](const char* name) {
      return run.warehouse.variable(data::Generation::old, run.table.find(name, 0), patch).values;
    };
    for (int k = 0; k < run.warehouse.particles(data::Generation::old, 0, patch).owned(); ++k) {
      const double x = reinterpret_cast<const double*>(read("p.x"))[k];
      positions[reinterpret_cast<const ParticleId*>(read("p.particleID"))[k]] = x;
      EXPECT_EQ(reinterpret_cast<const double*>(read("p.density"))[k], 2 + x);
      EXPECT_EQ(reinterpret_cast<const double*>(read("p.velocity"))[k], x);
      EXPECT_NEAR(reinterpret_cast<const double*>(read("p.internalEnergy"))[k], 1 / (0.4 * (2 + x)), 1e-15);
    }
  }
  return positions;
}

}  // namespace

TEST(CreateParticles, PutsThemInTheMiddleOfEqualPartsWhereTheShapeIs) {
  const auto positions = made(gasOf({{"[0.2,-1,-1]", "[0.5,2,2]"}}, 4), 1);

  ASSERT_EQ(positions.size(), 12u);
  int k = 0;
  for (const auto& [id, x] : positions) EXPECT_NEAR(x, 0.2 + (k++ + 0.5) * 0.025, 1e-15);
}

TEST(CreateParticles, GivesTheSameIdsOnAnyPatches) {
  const Gas gas = gasOf({{"[0,-1,-1]", "[0.5,2,2]"}, {"[0.5,-1,-1]", "[2,2,2]"}}, 3);

  const auto reference = made(gas, 1);

  EXPECT_EQ(reference.size(), 30u);
  for (const int patches : {2, 7, 10}) EXPECT_EQ(made(gas, patches), reference);
}

TEST(CreateParticles, GivesAPlaceOnASharedFaceToTheUpperBody) {
  EXPECT_EQ(made(gasOf({{"[0,-1,-1]", "[0.25,2,2]"}, {"[0.25,-1,-1]", "[2,2,2]"}}, 1), 1).size(), 10u);
  EXPECT_EQ(made(gasOf({{"[0,-1,-1]", "[0.25,2,2]"}}, 1), 1).size(), 2u);
}

TEST(CreateParticles, DrawsAPlaceInEachPartOfACellWhereJittered) {
  Gas gas = gasOf({{"[0,-1,-1]", "[2,2,2]"}}, 4);
  gas.objects[0].placement = Placement::jittered;

  const auto positions = made(gas, 1);

  ASSERT_EQ(positions.size(), 40u);
  int k = 0;
  double spread = 0;
  for (const auto& [id, x] : positions) {
    const double within = x * 40 - k++;
    EXPECT_TRUE(within > 0 && within < 1);
    spread += (within - 0.5) * (within - 0.5) / 40;
  }
  EXPECT_NEAR(spread, 1.0 / 12, 0.02);
}

TEST(CreateParticles, DrawsPlacesThatFollowFromSeedCellAndNumberAlone) {
  Gas gas = gasOf({{"[0,-1,-1]", "[0.45,2,2]"}, {"[0.45,-1,-1]", "[2,2,2]"}}, 5);
  for (GasObject& object : gas.objects) object.placement = Placement::random;
  const auto reference = made(gas, 1);

  for (const int patches : {2, 7, 10}) EXPECT_EQ(made(gas, patches), reference);
  gas.objects[0].seed = 1;
  const auto other = made(gas, 3);
  const auto last = [](const auto& positions) { return positions.rbegin()->second; };
  EXPECT_NE(other.begin()->second, reference.begin()->second);
  EXPECT_EQ(last(other), last(reference));
}

TEST(CreateParticles, DrawsNumbersThatAreSpreadEvenlyAndNeverTwice) {
  std::set<double> numbers;
  double sum = 0;
  for (std::uint64_t cell = 0; cell < 100; ++cell)
    for (int place = 0; place < 10; ++place)
      for (int axis = 0; axis < 3; ++axis) {
        const double number = drawn(3, cell, place, axis);
        EXPECT_TRUE(number > 0 && number < 1);
        numbers.insert(number);
        sum += number;
      }
  EXPECT_EQ(numbers.size(), 3000u);
  EXPECT_NEAR(sum / 3000, 0.5, 0.02);
}

TEST(CreateParticles, RefusesBodiesThatOverlapNamingThePoint) {
  try {
    made(gasOf({{"[0,-1,-1]", "[0.6,2,2]"}, {"[0.5,-1,-1]", "[2,2,2]"}}, 1), 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("both contain the point (0.55, 0.3, 0.2)"), std::string::npos)
        << error.what();
  }
}

TEST(Totals, AreSumsOverTheParticles) {
  const Grid grid(test::domain({{2, 1, 1}}));
  const Level& level = grid.level();
  data::ParticleSet set;
  set.reset(grid.patches().front(), 0);
  set.at(Index<1>{{0}}) = {0, 2};
  set.at(Index<1>{{1}}) = {2, 3};
  set.setOwned(3);
  const std::vector<double> mass{1, 2, 3}, energy{5, 6, 7};
  const std::vector<Vec<1>> v{Vec<1>(1.0), Vec<1>(-2.0), Vec<1>(0.5)};
  const ParticleView<const double> m(mass.data(), set, level.cells()), e(energy.data(), set, level.cells());
  const ParticleView<const Vec<1>> u(v.data(), set, level.cells());
  Sum total, kinetic, internal, both;
  VectorSum momentum;

  sumMass<1>(grid.patches().front(), Gas(), m, total);
  sumMomentum<1>(grid.patches().front(), Gas(), m, u, momentum);
  sumEnergy<1>(grid.patches().front(), Gas(), m, u, e, kinetic, internal, both);

  EXPECT_EQ(total.total(), 6);
  EXPECT_EQ(momentum.values(), (std::vector<double>{-1.5, 0, 0}));
  EXPECT_EQ(kinetic.total(), 0.5 + 4 + 0.375);
  EXPECT_EQ(internal.total(), 38);
  EXPECT_EQ(both.total(), 42.875);
}

}  // namespace tushar::mpm::gas
