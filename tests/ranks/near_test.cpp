#include <gtest/gtest.h>

#include "tests/ranks/ranks.hpp"

// Node variables with values near particles only.

namespace tushar::tasks {

namespace {

using namespace test;

constexpr NodeLabel<double> nearby{"g.nearby", "1", "number of the node", Counts::nearParticles};
constexpr ParticleLabel<Vec<2>> x{"p.x", "m", "position"};
constexpr double untouched = -1;

struct Material {
  std::string name;
};
const std::vector<Material> body{{"body"}};

/// Whether a cell contains particles; such cells form a block.
bool holds(const Index<2>& cell) { return cell[0] > 7 && cell[0] < 11 && cell[1] > 1 && cell[1] < 5; }

/// Whether a particle is within two cells of a node or of one of its periodic images.
bool isNear(const Index<2>& node, bool periodic) {
  bool near = false;
  forEach<2>({{{-2, -2, 0}}, {{2, 2, 1}}}, [&](const Index<2>& beside) {
    Index<2> cell = node + beside;
    if (periodic) cell = {{(cell[0] + 24) % 12, (cell[1] + 20) % 10}};
    near |= holds(cell);
  });
  return near;
}

/// The number of nodes with wrong values, and the number of patches that received values from others.
struct Exchanged {
  double wrong, given;
};

/// Each patch numbers its own nodes, and reads one layer beyond. If `looks`, the numbering reads ghosts of particles;
/// otherwise it is unknown which nodes are near particles.
Exchanged exchange(const mpi::Communicator& ranks, const Index3& patches, bool periodic, bool looks, int threads = 1) {
  constexpr data::ReductionLabel<Sum> given{"given", "1", "nodes that came from other patches"};
  test::Runner run(plane(patches, periodic), threads, ranks);
  TaskList start, list;
  start.newParticles(
      "create",
      [](const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<2>>& at) {
        forEach<2>(patch.cells(), [&](const Index<2>& cell) {
          if (!holds(cell)) return;
          maker.add(cell, patch.level().cellNumber(cell));
          at.push_back(patch.level().cellCentre<2>(cell));
        });
      },
      body, creates(x));
  list.perMaterial(
      "fill",
      [periodic](const Patch&, const Material&, ParticleView<const Vec<2>>, NodeView<double> nodes) {
        nodes.fill(untouched);
        forEach<2>(nodes.box(), [&](const Index<2>& at) { nodes[at] = numberOf(at, periodic); });
      },
      body, requiresOld(x, looks ? 2 : 0), computesOwn(nearby));
  list.perMaterial(
      "check",
      [&run, periodic, looks](const Patch& patch, const Material&, NodeView<const double> nodes, Sum& bad, Sum& had) {
        const Box& own = run.grid.ownNodes(patch.id());
        forEach<2>(nodes.box(), [&](const Index<2>& at) {
          const bool isKnown = own.contains(at) || !looks || isNear(at, periodic);
          bad.add(nodes[at] != (isKnown ? numberOf(at, periodic) : untouched));
          had.add(isKnown && !own.contains(at));
        });
      },
      body, requiresNew(nearby, 1), computes(wrong), computes(given));
  TaskGraph begin = run.compile(start, {"p.x"}), step = run.compile(list, {"p.x", "wrong", "given"}, true);
  run.step(begin);
  run.step(step);
  const auto valueOf = [&](const char* name) { return run.warehouse.reductionValues(run.table.find(name, -1)).at(0); };
  return {valueOf("wrong"), valueOf("given")};
}

}  // namespace

TEST(NearRows, AreAllThatPatchesOfAnyRankGiveOneAnother) {
  for (const int some : {1, 2, 3, 4})
    onRanks(some, [](const mpi::Communicator& ranks) {
      for (const Index3& patches : {Index3{{2, 1, 1}}, Index3{{3, 2, 1}}, Index3{{4, 5, 1}}})
        for (const bool periodic : {false, true}) {
          const Exchanged outcome = exchange(ranks, patches, periodic, true, ranks.size() == 1 ? 2 : 1);
          EXPECT_EQ(outcome.wrong, 0) << ranks.size() << " ranks, " << patches[0] << " x " << patches[1];
          EXPECT_GT(outcome.given, patches[0] > 2 ? 0 : -1);
        }
    });
}

TEST(NearRows, AreAllRowsWhereNobodyHasLookedForGhosts) {
  for (const int some : {1, 3})
    onRanks(some, [](const mpi::Communicator& ranks) {
      for (const bool periodic : {false, true}) {
        const Exchanged all = exchange(ranks, {{3, 2, 1}}, periodic, false);
        EXPECT_EQ(all.wrong, 0) << ranks.size() << " ranks";
        EXPECT_GT(all.given, exchange(ranks, {{3, 2, 1}}, periodic, true).given);
      }
    });
}

TEST(NearRows, LeaveSavedValuesOfOtherNodesAt0) {
  onRanks(2, [](const mpi::Communicator& ranks) {
    test::Runner run(plane({{3, 2, 1}}, false), 1, ranks);
    TaskList step;
    step.perMaterial(
        "write",
        [](const Patch&, const Material&, NodeView<double> nodes) {
          forEach<2>(nodes.box(), [&](const Index<2>& at) {
            if (holds(at)) nodes[at] = 3;
          });
        },
        body, computes(nearby));
    step.perMaterial(
        "check",
        [](const Patch&, const Material&, NodeView<const double> nodes, Sum& bad) {
          forEach<2>(nodes.box(), [&](const Index<2>& at) { bad.add(!(nodes[at] == (holds(at) ? 3 : 0))); });
        },
        body, requiresNew(nearby), computes(wrong));
    TaskGraph graph = run.compile(step, {"g.nearby", "wrong"});
    for (int k = 0; k < 2; ++k) run.step(graph);
    EXPECT_EQ(run.warehouse.reductionValues(run.table.find("wrong", -1)).at(0), 0);
  });
}

}  // namespace tushar::tasks
