#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

#include "core/base/error.hpp"
#include "core/tasks/patch_migration.hpp"
#include "tests/ranks/ranks.hpp"

// Ghosts, relocation and reductions over several ranks.

namespace tushar::tasks {

namespace {

using namespace test;

constexpr NodeLabel<double> nodeNumber{"g.number", "1", "number of the node"};
constexpr ParticleLabel<Vec<2>> x{"p.x", "m", "position"};
constexpr ParticleLabel<double> mark{"p.mark", "1", "a value that belongs to the id"};
constexpr data::ReductionLabel<Sum> count{"count", "1", "particles"};
constexpr data::ReductionLabel<Sum> wrongBefore{"wrongBefore", "1", "the same at the start of the step"};
constexpr data::ReductionLabel<Sum> countBefore{"countBefore", "1", "particles at the start of the step"};

struct Material {
  std::string name;
};
const std::vector<Material> gas{{"gas"}};

double valueOf(test::Runner& run, const char* reduction) {
  return run.warehouse.reductionValues(run.table.find(reduction, -1)).at(0);
}

/// Returns the number of ghosts within `width` that differ from their owners' values, over all ranks.
double differingGhosts(const mpi::Communicator& ranks, const Index3& patches, int width, bool periodic) {
  test::Runner run(plane(patches, periodic), 1, ranks);
  TaskList list;
  list.perPatch(
      "fill",
      [periodic](const Patch& patch, CellView<double> cells, NodeView<double> nodes) {
        forEach<2>(patch.cells(), [&](const Index<2>& at) { cells[at] = numberOf(at, periodic); });
        forEach<2>(patch.nodes(), [&](const Index<2>& at) { nodes[at] = numberOf(at, periodic); });
      },
      computes(number), computes(nodeNumber));
  list.perPatch(
      "check",
      [periodic](const Patch&, CellView<const double> cells, NodeView<const double> nodes, Sum& bad) {
        forEach<2>(cells.box(), [&](const Index<2>& at) { bad.add(cells[at] != numberOf(at, periodic)); });
        forEach<2>(nodes.box(), [&](const Index<2>& at) { bad.add(nodes[at] != numberOf(at, periodic)); });
      },
      requiresNew(number, width), requiresNew(nodeNumber, width), computes(wrong));
  TaskGraph graph = run.compile(list, {"wrong"});
  run.step(graph);
  return valueOf(run, "wrong");
}

/// Two particles in each cell. On a periodic grid, they jump by some cells in each step; on a grid with ends, they
/// rest.
class Swarm {
 public:
  /// If `fails`, the rank fails once, at the start of a step.
  Swarm(const mpi::Communicator& ranks, const Index3& patches, double jump, bool fails = false)
      : run(plane(patches, jump > 0), 1, ranks), failing(fails) {
    TaskList start, advance;
    start.newParticles("create", create, gas, creates(x), creates(mark));
    advance.perMaterial(
        "fail",
        [this](const Patch&, const Material&, ParticleView<const Vec<2>>, Minimum&) {
          if (std::exchange(failing, false)) throw NumericalError("made to fail", "", "value");
        },
        gas, requiresOld(x), computes(data::recomputeTimeStep));
    advance.perMaterial("inspect the start", inspect, gas, requiresOld(x, 1), requiresOld(data::particleId, 1),
                        requiresOld(mark, 1), computes(wrongBefore), computes(countBefore));
    advance.perMaterial(
        "move",
        [jump](const Patch& patch, const Material&, ParticleView<const Vec<2>> from, ParticleView<Vec<2>> to) {
          for (int p = 0; p < from.owned(); ++p)
            to[p] = from[p] + Vec<2>(jump * patch.level().spacing(0),
                                     std::sin(40 * from[p][0]) * jump * patch.level().spacing(1));
        },
        gas, requiresOld(x), computes(x));
    advance.relocate(x, gas);
    advance.perMaterial("inspect", inspect, gas, requiresNew(x, 1), requiresNew(data::particleId, 1),
                        requiresNew(mark, 1), computes(wrong), computes(count));
    begin = run.compile(start, {"p.x", "p.mark"});
    step = run.compile(advance, {"p.x", "p.mark", "wrong", "count", "wrongBefore", "countBefore", "recomputeTimeStep"},
                       true);
    run.step(begin);
  }
  /// From now on, patches move between ranks before each step: all to one rank, or each to another rank.
  void keepMoving() { moves = true; }
  /// Whether a repeatable step must be repeated.
  bool isRepeated() {
    StepInfo at;
    at.mayRepeat = true;
    return run.scheduler.run(step, at).has_value();
  }
  /// Returns the number of errors after a number of steps, and the number of particles.
  std::pair<double, double> after(int steps) {
    double all = 0;
    for (int k = 0; k < steps; ++k) {
      if (moves) move(k);
      run.step(step);
      all += valueOf(run, "wrong") + valueOf(run, "wrongBefore");
    }
    return {all, valueOf(run, "count")};
  }

 private:
  void move(int turn) {
    const int ranks = run.grid.share().ranks, patches = run.grid.patchCount();
    grid::RankOffsets offsets{0};
    for (int rank = 1; rank < ranks; ++rank)
      offsets.push_back(turn % 2 == 0 ? patches : patches * rank * rank / (ranks * ranks));
    offsets.push_back(patches);
    const MigratedVariables migrated{
        1, {run.table.find("p.x", 0), run.table.find("p.mark", 0), run.table.find(data::particleId.name, 0)}};
    migratePatches(run.grid, run.warehouse, migrated, offsets);
    run.scheduler.forgetLayout();
  }
  static void create(const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<2>>& at,
                     std::vector<double>& marks) {
    forEach<2>(patch.cells(), [&](const Index<2>& cell) {
      for (ParticleId k = 0; k < 2; ++k) {
        const ParticleId id = 2 * patch.level().cellNumber(cell) + k;
        maker.add(cell, id);
        at.push_back(patch.level().cellCentre<2>(cell));
        marks.push_back(0.5 + static_cast<double>(id));
      }
    });
  }
  /// Counts particles in a wrong cell, with a wrong mark or unsorted; ghosts lie beyond the grid.
  static void inspect(const Patch& patch, const Material&, ParticleView<const Vec<2>> at,
                      ParticleView<const ParticleId> ids, ParticleView<const double> marks, Sum& bad, Sum& all) {
    forEach<2>(at.cells(), [&](const Index<2>& cell) {
      ParticleId before = 0;
      for (const int p : at.in(cell)) {
        for (int d = 0; d < 2; ++d)
          bad.add(std::abs(at[p][d] - patch.level().cellCentre<2>(cell)[d]) > 0.5001 * patch.level().spacing(d));
        bad.add(marks[p] != 0.5 + static_cast<double>(ids[p]) || (before > 0 && ids[p] <= before));
        before = ids[p];
      }
    });
    all.add(at.owned());
  }

  test::Runner run;
  TaskGraph begin, step;
  bool moves = false, failing;
};

}  // namespace

TEST(Ranks, FillGhostsFromOneAnother) {
  for (const int ranks : {2, 3, 4})
    onRanks(ranks, [](const mpi::Communicator& some) {
      for (const Index3& patches : {Index3{{2, 1, 1}}, {{4, 3, 1}}, {{12, 10, 1}}})
        for (const bool periodic : {false, true})
          EXPECT_EQ(differingGhosts(some, patches, periodic ? 3 : 1, periodic), 0)
              << some.size() << " ranks, " << patches[0] << " x " << patches[1] << " patches";
    });
}

TEST(Ranks, WorkOnPatchesThatNeedNoMessageBeforeThoseThatWaitForOne) {
  onRanks(2, [](const mpi::Communicator& some) {
    test::Runner run(plane({{12, 10, 1}}, false), 1, some);
    std::vector<int> order;
    TaskList list;
    list.perPatch(
        "fill",
        [](const Patch& patch, CellView<double> cells) {
          forEach<2>(patch.cells(), [&](const Index<2>& at) { cells[at] = 1; });
        },
        computes(number));
    list.perPatch(
        "read", [&order](const Patch& patch, CellView<const double>, Sum&) { order.push_back(patch.id()); },
        requiresNew(number, 1), computes(wrong));
    TaskGraph graph = run.compile(list, {"wrong"});
    run.step(graph);

    const auto needsNoMessage = [&](int id) {
      const std::vector<Patch> near = run.grid.patchesOverlapping(run.grid.patch(id).cellsWithin(1), 0);
      return std::all_of(near.begin(), near.end(), [&](const Patch& patch) { return run.grid.isMine(patch.id()); });
    };
    EXPECT_EQ(order.size(), run.grid.patches().size());
    EXPECT_TRUE(std::is_partitioned(order.begin(), order.end(), needsNoMessage));
    EXPECT_TRUE(std::any_of(order.begin(), order.end(), needsNoMessage));
    EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
  });
}

TEST(Ranks, HandParticlesToOneAnother) {
  for (const int ranks : {2, 4})
    onRanks(ranks, [](const mpi::Communicator& some) {
      for (const Index3& patches : {Index3{{2, 1, 1}}, {{12, 10, 1}}})
        for (const double jump : {0.3, 5.2})  // the second to ranks that are no neighbours
          EXPECT_EQ(Swarm(some, patches, jump).after(4), std::pair(0.0, 240.0))
              << some.size() << " ranks, jump " << jump;
    });
}

TEST(Ranks, MayGivePatchesToOneAnotherBetweenSteps) {
  for (const int ranks : {2, 4})
    onRanks(ranks, [](const mpi::Communicator& some) {
      for (const Index3& patches : {Index3{{2, 1, 1}}, {{12, 10, 1}}}) {
        Swarm swarm(some, patches, 0.3);
        swarm.keepMoving();
        EXPECT_EQ(swarm.after(5), std::pair(0.0, 240.0)) << some.size() << " ranks";
      }
    });
}

TEST(Ranks, UseAsManyThreadsAsTheyHavePatchesFor) {
  onRanks(2, [](const mpi::Communicator& some) {
    test::Runner run(plane({{4, 3, 1}}, false), 4, some);
    EXPECT_EQ(run.scheduler.threads().count(), 4);

    for (const int first : {12, 2, 10}) {
      migratePatches(run.grid, run.warehouse, {}, {0, first, 12});
      run.scheduler.forgetLayout();
      const int patches = some.isFirst() ? first : 12 - first;
      EXPECT_EQ(run.scheduler.threads().count(), std::clamp(patches, 1, 4)) << patches << " patches";
    }
  });
}

TEST(Ranks, MeasureNoMoreThanTheClockByAnyNumberOfThreads) {
  using Clock = std::chrono::steady_clock;
  onRanks(2, [](const mpi::Communicator& some) {
    test::Runner run(plane({{4, 3, 1}}, false), 2, some);
    TaskList list;
    list.perPatch(
        "wait",
        [](const Patch&, CellView<double> cells) {
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
          cells.fill(1);
        },
        computes(number));
    TaskGraph graph = run.compile(list, {"c.number"});

    const auto started = Clock::now();
    run.step(graph);
    const double passed = std::chrono::duration<double>(Clock::now() - started).count();
    const std::vector<double> costs = run.scheduler.takeCosts();

    EXPECT_LE(std::accumulate(costs.begin(), costs.end(), 0.0), passed);
  });
}

/// Returns the number of wrong ghosts, and the message, where other tasks run between the task that computes the
/// ghosts' values and the one that reads them; one of these violates a bound on the last rank.
std::pair<double, std::string> readLater(const mpi::Communicator& ranks, bool breaks, bool mayRepeat = true) {
  test::Runner run(plane({{4, 3, 1}}, false), 1, ranks);
  TaskList list;
  list.perPatch(
      "fill",
      [](const Patch& patch, NodeView<double> nodes) {
        forEach<2>(patch.nodes(), [&](const Index<2>& at) { nodes[at] = numberOf(at, false); });
      },
      computes(nodeNumber));
  list.perPatch(
      "meanwhile",
      [breaks](const Patch& patch, CellView<double> cells) {
        cells.fill(breaks && patch.cells().contains(Index<2>{{11, 9}}) ? -1 : 1);
      },
      computes(number));
  list.perPatch(
      "check",
      [](const Patch&, CellView<const double>, NodeView<const double> nodes, Sum& bad) {
        forEach<2>(nodes.box(), [&](const Index<2>& at) { bad.add(nodes[at] != numberOf(at, false)); });
      },
      requiresNew(number), requiresNew(nodeNumber, 1), computes(wrong));
  TaskGraph graph = run.compile(list, {"wrong"});
  run.warehouse.grow(0);
  StepInfo at;
  at.mayRepeat = mayRepeat;
  try {
    const auto asked = run.scheduler.run(graph, at);
    const auto again = asked ? run.scheduler.run(graph, at) : asked;
    if (again) return {again->value, std::string(again->reason.text())};
  } catch (const NumericalError& error) {
    return {-1, error.what()};
  }
  run.scheduler.commit(graph);
  return {valueOf(run, "wrong"), ""};
}

TEST(Ranks, GoOnWithOtherTasksWhileGhostsAreOnTheirWay) {
  for (const int ranks : {2, 4})
    onRanks(ranks, [](const mpi::Communicator& some) {
      EXPECT_EQ(readLater(some, false), std::pair(0.0, std::string())) << some.size() << " ranks";
    });
}

TEST(Ranks, HearOfAFaultThatCameAfterGhostsWereSent) {
  const auto asked = readLater(mpi::Communicator::alone(), true),
             thrown = readLater(mpi::Communicator::alone(), true, false);
  EXPECT_EQ(asked.first, 0.5);
  EXPECT_EQ(thrown.first, -1);
  for (const int ranks : {2, 4})
    onRanks(ranks, [&](const mpi::Communicator& some) {
      EXPECT_EQ(readLater(some, true), asked);
      EXPECT_EQ(readLater(some, true, false), thrown);
      EXPECT_EQ(differingGhosts(some, {{4, 3, 1}}, 1, false), 0) << "something was left in the post";
    });
}

TEST(Ranks, RepeatAStepThatStoppedBeforeAllHadSettledTheirGhosts) {
  for (const int faulty : {0, 1, 2})
    onRanks(3, [faulty](const mpi::Communicator& some) {
      // On a grid with ends, the first patch of the first rank gets its ghosts from that rank, its other patches do
      // not.
      Swarm swarm(some, {{12, 10, 1}}, 0, some.rank() == faulty);
      EXPECT_TRUE(swarm.isRepeated());
      EXPECT_EQ(swarm.after(2), std::pair(0.0, 240.0)) << "rank " << faulty;
    });
}

}  // namespace tushar::tasks
