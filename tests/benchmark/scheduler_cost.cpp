#include <benchmark/benchmark.h>

#include <deque>
#include <string>

#include "tests/support/run.hpp"

// The costs of the scheduler: tasks that do nothing, each of which reads a variable of the previous one and computes
// its own on patches of one cell, with and without ghosts; compiling such a list; and relocating particles.

namespace {

using namespace tushar;
using data::CellLabel;
using data::CellView;
using grid::Patch;

/// A list of tasks that do nothing, but may read ghost cells.
class Chain {
 public:
  explicit Chain(int length, int ghost = 0) {
    for (int k = 0; k <= length; ++k) {
      names_.push_back("c.value" + std::to_string(k));
      labels_.emplace_back(names_.back(), "1", "nothing");
    }
    tasks.perPatch(
        "first", [](const Patch&, CellView<double>) {}, tasks::computes(labels_[0]));
    for (std::size_t k = 1; k < static_cast<std::size_t>(length); ++k)
      tasks.perPatch(
          "task " + std::to_string(k), [](const Patch&, CellView<const double>, CellView<double>) {},
          tasks::requiresNew(labels_[k - 1], ghost), tasks::computes(labels_[k]));
    wanted = {names_[length - 1]};
  }
  tasks::TaskList tasks;
  tasks::Names wanted;

 private:
  std::deque<std::string> names_;
  std::deque<CellLabel<double>> labels_;
};

grid::Domain line(int patches) { return test::domain({{patches, 1, 1}}, {{patches, 1, 1}}); }

/// Returns a counter of the nanoseconds per part, with `times` parts in an iteration.
::benchmark::Counter nanosecondsOf(double times) {
  return {times * 1e-9, ::benchmark::Counter::kIsIterationInvariantRate | ::benchmark::Counter::kInvert};
}

/// Benchmark arguments: number of tasks, patches and threads.
void execute(::benchmark::State& state) {
  const Chain chain(static_cast<int>(state.range(0)));
  test::Runner run(line(static_cast<int>(state.range(1))), static_cast<int>(state.range(2)));
  tasks::TaskGraph graph = run.compile(chain.tasks, chain.wanted);
  run.step(graph);
  for (auto _ : state) run.scheduler.run(graph, {});
  state.counters["wall_ns_per_execution"] = nanosecondsOf(static_cast<double>(state.range(0) * state.range(1)));
}

/// As `execute`, but each task reads a layer of ghost cells. Arguments: number of tasks, patches and threads.
void exchange(::benchmark::State& state) {
  const Chain chain(static_cast<int>(state.range(0)), 1);
  test::Runner run(line(static_cast<int>(state.range(1))), static_cast<int>(state.range(2)));
  tasks::TaskGraph graph = run.compile(chain.tasks, chain.wanted);
  run.step(graph);
  for (auto _ : state) run.scheduler.run(graph, {});
  state.counters["wall_ns_per_execution"] = nanosecondsOf(static_cast<double>(state.range(0) * state.range(1)));
}

struct Material {
  std::string name;
};
constexpr data::ParticleLabel<Vec<1>> position{"p.x", "m", "position"};
constexpr int perCell = 8;  ///< particles

void create(const Patch& patch, const Material&, tasks::ParticleMaker& maker, std::vector<Vec<1>>& x) {
  grid::forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    for (int k = 0; k < perCell; ++k) {
      maker.add(cell, patch.level().cellNumber(cell) * perCell + static_cast<ParticleId>(k));
      x.emplace_back(patch.level().nodePosition(0, cell[0]) + (k + 0.5) / perCell * patch.level().spacing(0));
    }
  });
}

/// Moves one of every `one` particles to the other cell of a pair of cells, and back in the next step.
void moveSome(const Patch& patch, const Material&, int one, data::ParticleView<const Vec<1>> from,
              data::ParticleView<const ParticleId> ids, data::ParticleView<Vec<1>> to) {
  for (int p = 0; p < from.owned(); ++p) {
    const int cell = patch.level().cellAlong(0, from[p][0]);
    const double middle = patch.level().nodePosition(0, cell - cell % 2 + 1);
    to[p] = one > 0 && ids[p] % static_cast<ParticleId>(one) == 0 ? Vec<1>(2 * middle - from[p][0]) : from[p];
  }
}

/// A step that moves particles and relocates them. Arguments: cells, patches, and n, where one of every n particles
/// moves (0: none).
void relocate(::benchmark::State& state) {
  const std::vector<Material> gas{{"gas"}};
  const int cells = static_cast<int>(state.range(0)), patches = static_cast<int>(state.range(1));
  test::Runner run(test::domain({{cells, 1, 1}}, {{patches, 1, 1}}));
  tasks::TaskList start, advance;
  start.newParticles("create", create, gas, tasks::creates(position));
  advance.perMaterial("move", moveSome, gas, tasks::with(static_cast<int>(state.range(2))),
                      tasks::requiresOld(position), tasks::requiresOld(data::particleId), tasks::computes(position));
  advance.relocate(position, gas);
  tasks::TaskGraph begin = run.compile(start, {"p.x", "p.particleID"});
  tasks::TaskGraph step = run.compile(advance, {"p.x"}, true);
  run.step(begin);
  for (auto _ : state) run.step(step);
  state.counters["wall_ns_per_particle"] = nanosecondsOf(static_cast<double>(cells * perCell));
}

/// Benchmark arguments: number of tasks and patches.
void compile(::benchmark::State& state) {
  const Chain chain(static_cast<int>(state.range(0)));
  const grid::Grid grid(line(static_cast<int>(state.range(1))));
  for (auto _ : state) {
    data::VariableTable table;
    const tasks::TaskGraph graph("chain", tasks::prune(chain.tasks.tasks(), chain.wanted, false), grid, table);
    ::benchmark::DoNotOptimize(graph.tasks().data());
  }
  state.counters["processor_us_per_task_and_patch"] =
      ::benchmark::Counter(static_cast<double>(state.range(0) * state.range(1)) * 1e-6,
                           ::benchmark::Counter::kIsIterationInvariantRate | ::benchmark::Counter::kInvert);
}

BENCHMARK(execute)
    ->Args({100, 1000, 1})
    ->Args({100, 1000, 2})
    ->Args({1000, 100, 1})
    ->Args({1000, 100, 2})
    ->UseRealTime();
BENCHMARK(exchange)->Args({100, 1000, 1})->Args({100, 1000, 2})->UseRealTime();
BENCHMARK(relocate)
    ->Args({100, 1, 0})
    ->Args({100, 1, 64})
    ->Args({10000, 1, 0})
    ->Args({10000, 1, 64})
    ->Args({10000, 100, 64})
    ->UseRealTime();
BENCHMARK(compile)->Args({100, 1})->Args({1000, 1})->Args({100, 1000});

}  // namespace

BENCHMARK_MAIN();
