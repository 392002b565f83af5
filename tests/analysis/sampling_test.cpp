#include "components/analysis/sampling.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/support/temporary.hpp"

namespace tushar::analysis {
namespace {

/// Returns those of the given times at which a sample is due; the run starts at time 0.
std::vector<double> due(SampleTimes times, const std::vector<double>& steps) {
  std::vector<double> found;
  for (const double t : steps) {
    times.pass(t, t);
    if (times.isDue()) found.push_back(t);
  }
  return found;
}

TEST(SampleTimes, TakesEveryStepAtAHighFrequencyButNotTheInitialState) {
  EXPECT_EQ(due({1e10, 0, 100}, {0, .1, .2, .3}), (std::vector<double>{.1, .2, .3}));
}

TEST(SampleTimes, TakesTheFirstStepAndThoseThatPassAMultiple) {
  EXPECT_EQ(due({2, 0, 100}, {0, .1, .2, .6, .7, 1.1, 1.2}), (std::vector<double>{.1, .6, 1.1}));
}

TEST(SampleTimes, KeepsToStartAndStop) {
  EXPECT_EQ(due({1e10, .2, .4}, {0, .1, .25, .3, .4, .5}), (std::vector<double>{.25, .3, .4}));
}

TEST(SampleTimes, GoesOnFromACheckpointAsIfNothingHadHappened) {
  const std::vector<double> all{0, .1, .2, .6, .7, 1.1, 1.2, 1.6};
  const std::vector<double> whole = due({2, .15, 100}, all);
  for (std::size_t cut = 0; cut < all.size(); ++cut) {
    std::vector<double> parts = due({2, .15, 100}, {all.begin(), all.begin() + static_cast<long>(cut) + 1});
    for (const double t : due({2, .15, 100}, {all.begin() + static_cast<long>(cut), all.end()})) parts.push_back(t);
    EXPECT_EQ(parts, whole) << cut;
  }
}

TEST(SampleTimes, LooksOnceAtATimeThatIsToldTwice) {
  SampleTimes times(2, 0, 100);
  for (const double t : {0., .1, .6}) times.pass(t, t);
  times.pass(.6, .6);
  EXPECT_TRUE(times.isDue());
  times.pass(.7, .7);
  EXPECT_FALSE(times.isDue());
}

TEST(LinesBefore, KeepsTheWholeLinesBeforeWhereARunGoesOn) {
  const std::string before = "# Time    X\n0.000000E+00\t 1\n5.000000E+01\t 2\n";
  EXPECT_EQ(linesBefore(before + "1.000000E+02\t 3\n1.500000E+02\t 4\n", 100), before);
  EXPECT_EQ(linesBefore(before + "1.0", 100), before) << "the rest of 1.0e+02 was never written";
  EXPECT_EQ(linesBefore(before, 200), before);
  EXPECT_EQ(linesBefore("", 1), "");
}

TEST(LinesBefore, FindsTheTimeInItsColumn) {
  EXPECT_EQ(linesBefore("# X Y Time\n9 9 1\n9 9 2\n", 2, 2), "# X Y Time\n9 9 1\n");
}

TEST(SampleFiles, TakeOutTheLinesThatARunWritesAgain) {
  const std::filesystem::path file = test::temporaryFolder() + "sampled_line";
  const auto text = [&] {
    std::ifstream in(file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  SampleFiles first;
  for (const char* line : {"1 a\n", "2 b\n", "3 c\n"}) first.add(file, "# head\n", line, line[0] - '0');
  EXPECT_EQ(text(), "# head\n1 a\n2 b\n3 c\n");
  SampleFiles second;
  second.add(file, "# head\n", "2 B\n", 2);
  EXPECT_EQ(text(), "# head\n1 a\n2 B\n");
}

}  // namespace
}  // namespace tushar::analysis
