#include "core/tasks/move_runs.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace tushar::tasks {

namespace {

struct Run {
  int to, from, count;
};

/// Runs of 1 to 9 elements, with gaps of up to 3 elements before and after, in the same order; and the number of
/// elements that they need.
std::pair<std::vector<Run>, int> someRuns(std::mt19937& random) {
  std::uniform_int_distribution<int> gap(0, 3), length(1, 9);
  std::vector<Run> runs;
  int to = 0, from = 0;
  for (int k = 0; k < 40; ++k) {
    to += gap(random);
    from += gap(random);
    runs.push_back({to, from, length(random)});
    to += runs.back().count;
    from += runs.back().count;
  }
  return {runs, std::max(to, from)};
}

std::byte* bytesOf(std::vector<double>& values) { return reinterpret_cast<std::byte*>(values.data()); }

}  // namespace

TEST(MoveRuns, MovesWithinTheSameMemoryAsFromACopy) {
  std::mt19937 random(7);
  for (const int numbers : {1, 2, 3, 4, 5, 6, 9, 21})
    for (int trial = 0; trial < 20; ++trial) {
      const auto [runs, elements] = someRuns(random);
      std::vector<double> values(static_cast<std::size_t>(elements * numbers));
      std::iota(values.begin(), values.end(), 1.0);
      const std::vector<double> before = values;
      moveRuns(runs, bytesOf(values), bytesOf(values), static_cast<std::size_t>(numbers) * sizeof(double));
      for (const auto& run : runs)
        for (int k = 0; k < run.count * numbers; ++k)
          ASSERT_EQ(values[static_cast<std::size_t>(run.to * numbers + k)],
                    before[static_cast<std::size_t>(run.from * numbers + k)]);
    }
}

}  // namespace tushar::tasks
