#include <benchmark/benchmark.h>

#include "components/components.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/benchmark/plain_loop.hpp"

// The cost of the framework: the time loop of ups/mpm/sod.ups compared with a hand-written loop of the same method.
// tools/benchmark runs both interleaved and prints the ratio.

namespace {

using namespace tushar;

/// Measures the time loop of Sod's tube, without output, as given by the report of the run.
void framework(::benchmark::State& state) {
  const std::string resolution = "Grid/Level/Box/resolution=[" + std::to_string(state.range(0)) + ",1,1]";
  simulation::RunOptions options;
  options.quiet = true;
  for (auto _ : state) {
    simulation::Problem problem = scene::readScene("ups/mpm/sod.ups", {resolution}, catalogue());
    problem.archive.saves.clear();
    simulation::Simulation run(std::move(problem), options, std::chrono::steady_clock::now());
    const report::Report report = run.run();
    state.SetIterationTime(report.wallLoop);
    state.counters["us_per_step"] = 1e6 * report.wallLoop / report.steps;
  }
}

void plainLoop(::benchmark::State& state) {
  for (auto _ : state) {
    tushar::benchmark::PlainLoop loop(static_cast<int>(state.range(0)));
    const auto started = std::chrono::steady_clock::now();
    const int steps = loop.run();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    ::benchmark::DoNotOptimize(loop.density().data());
    state.SetIterationTime(seconds);
    state.counters["us_per_step"] = 1e6 * seconds / steps;
  }
}

BENCHMARK(framework)->Arg(100)->Arg(800)->UseManualTime()->Unit(::benchmark::kMillisecond);
BENCHMARK(plainLoop)->Arg(100)->Arg(800)->UseManualTime()->Unit(::benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
