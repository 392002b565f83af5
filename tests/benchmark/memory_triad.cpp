#include <benchmark/benchmark.h>

#include <vector>

// The bandwidth of memory: a = b + s c on arrays too large for any cache, three numbers moved for each. The triad of
// McCalpin's STREAM, IEEE Comput. Soc. TCCA Newsletter (1995) 19.

namespace {

void triad(benchmark::State& state) {
  const std::size_t count = 20'000'000;
  std::vector<double> a(count), b(count, 1.0), c(count, 2.0);
  for (auto iteration : state) {
    for (std::size_t k = 0; k < count; ++k) a[k] = b[k] + 3 * c[k];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  }
  const double bytes = static_cast<double>(state.iterations()) * static_cast<double>(3 * count * sizeof(double));
  state.counters["GB_per_s"] = benchmark::Counter(bytes / 1e9, benchmark::Counter::kIsRate);
}
BENCHMARK(triad)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
