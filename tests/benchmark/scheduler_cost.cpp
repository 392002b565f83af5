#include <benchmark/benchmark.h>

#include <deque>
#include <string>

#include "tests/support/run.hpp"

// What the scheduler costs: tasks that do nothing, one after another, each reading what the one before computed and
// computing a variable of its own on patches of one cell; and compiling such a list.

namespace {

using namespace tushar;
using data::CellLabel;
using data::CellView;
using grid::Patch;

/// A list of tasks that do nothing.
class Chain {
 public:
  explicit Chain(int length) {
    for (int k = 0; k <= length; ++k) {
      names_.push_back("c.value" + std::to_string(k));
      labels_.emplace_back(names_.back(), "1", "nothing");
    }
    tasks.perPatch(
        "first", [](const Patch&, CellView<double>) {}, tasks::computes(labels_[0]));
    for (std::size_t k = 1; k < static_cast<std::size_t>(length); ++k)
      tasks.perPatch(
          "task " + std::to_string(k), [](const Patch&, CellView<const double>, CellView<double>) {},
          tasks::requiresNew(labels_[k - 1]), tasks::computes(labels_[k]));
    wanted = {names_[length - 1]};
  }
  tasks::TaskList tasks;
  tasks::Names wanted;

 private:
  std::deque<std::string> names_;
  std::deque<CellLabel<double>> labels_;
};

grid::Domain line(int patches) { return test::domain({{patches, 1, 1}}, {{patches, 1, 1}}); }

/// Arguments: tasks, patches, threads.
void execute(::benchmark::State& state) {
  const Chain chain(static_cast<int>(state.range(0)));
  test::Runner run(line(static_cast<int>(state.range(1))), static_cast<int>(state.range(2)));
  tasks::TaskGraph graph = run.compile(chain.tasks, chain.wanted);
  run.step(graph);
  for (auto _ : state) run.scheduler.run(graph, {});
  state.counters["wall_ns_per_execution"] =
      ::benchmark::Counter(static_cast<double>(state.range(0) * state.range(1)) * 1e-9,
                           ::benchmark::Counter::kIsIterationInvariantRate | ::benchmark::Counter::kInvert);
}

/// Arguments: tasks, patches.
void compile(::benchmark::State& state) {
  const Chain chain(static_cast<int>(state.range(0)));
  const grid::Level level(line(static_cast<int>(state.range(1))));
  for (auto _ : state) {
    data::VariableTable table;
    const tasks::TaskGraph graph("chain", tasks::prune(chain.tasks.tasks(), chain.wanted, false), level, table);
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
BENCHMARK(compile)->Args({100, 1})->Args({1000, 1})->Args({100, 1000});

}  // namespace

BENCHMARK_MAIN();
