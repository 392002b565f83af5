#include "core/base/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/environment.hpp"

namespace tushar {

namespace {

constexpr int counts[] = {1, 2, 3, 8};

/// Runs a loop whose indices in `failing` throw their own numbers; returns the message caught and the number of calls.
std::pair<std::string, int> failureOf(Threads& threads, const std::vector<int>& failing, int times) {
  std::atomic<int> calls = 0;
  try {
    threads.forEach(times, [&](int k) {
      ++calls;
      for (const int one : failing)
        if (one == k) throw std::runtime_error(std::to_string(k));
    });
  } catch (const std::runtime_error& error) {
    return {error.what(), calls};
  }
  return {"none", calls};
}

}  // namespace

TEST(Threads, CallTheLoopOnceForEachNumber) {
  for (const int count : counts) {
    Threads threads(count);
    for (const int times : {0, 1, 2, 7, 1000}) {
      std::vector<std::atomic<int>> calls(times);
      threads.forEach(times, [&](int k) { ++calls[k]; });
      for (const std::atomic<int>& called : calls) EXPECT_EQ(called, 1) << count << " threads, " << times << " times";
    }
  }
}

TEST(Threads, MakeIterationsInTheOrderOfTheDistribution) {
  Threads threads(2);
  threads.distribute({6, 6, 1, 1});
  EXPECT_EQ(threads.order(), (std::vector<int>{0, 2, 1, 3}));
  threads.resize(1);  // so that there is one sequence
  std::vector<int> made;
  threads.forEach(4, [&](int k) { made.push_back(k); });
  EXPECT_EQ(made, threads.order());
  made.clear();
  threads.forEach(3, [&](int k) { made.push_back(k); });
  EXPECT_EQ(made, (std::vector<int>{0, 1, 2}));  // a loop of another length
}

TEST(Threads, KeepADistributionThatIsNearlyAsEven) {
  Threads threads(2);
  threads.distribute({6, 1, 6.2, 1});
  EXPECT_TRUE(threads.order().empty());
  threads.distribute({6, 6, 1, 1});
  const std::vector<int> order = threads.order();
  EXPECT_FALSE(order.empty());
  threads.distribute({6, 6.2, 1, 1});
  EXPECT_EQ(threads.order(), order);
  threads.distribute({});
  EXPECT_TRUE(threads.order().empty());
}

TEST(Threads, CallTheLoopOnceForEachNumberInAnyDistribution) {
  Threads threads(3);
  for (const std::vector<double>& costs : {std::vector<double>{}, {0, 0, 0}, {5, 1, 1}, {1, 2, 3, 4, 5, 6, 7}, {9}}) {
    threads.distribute(costs);
    for (const int times : {1, 3, 7, 10}) {
      std::vector<std::atomic<int>> calls(times);
      threads.forEach(times, [&](int k) { ++calls[k]; });
      for (const std::atomic<int>& called : calls) EXPECT_EQ(called, 1) << costs.size() << " costs, " << times;
    }
  }
}

TEST(Threads, ReportTheFailureOfTheLowestNumberInAnyDistribution) {
  Threads threads(2);
  threads.distribute({1, 2, 3, 4});
  EXPECT_EQ(failureOf(threads, {3, 1}, 4), std::pair(std::string("1"), 4));
}

TEST(Threads, WorkAtTheSameTime) {
  Threads threads(2);
  std::mutex mutex;
  std::condition_variable both;
  int inside = 0;

  // Each waits for the other: this only ends if both run at once.
  threads.forEach(2, [&](int) {
    std::unique_lock<std::mutex> lock(mutex);
    ++inside;
    both.notify_all();
    both.wait(lock, [&] { return inside == 2; });
  });

  EXPECT_EQ(inside, 2);
}

TEST(Threads, ThrowTheFirstOfSeveralExceptionsOnceAllElseIsDone) {
  for (const int count : counts) {
    Threads threads(count);
    EXPECT_EQ(failureOf(threads, {}, 64), (std::pair<std::string, int>("none", 64)));
    EXPECT_EQ(failureOf(threads, {63}, 64), (std::pair<std::string, int>("63", 64)));
    for (int repeat = 0; repeat < 20; ++repeat)
      EXPECT_EQ(failureOf(threads, {50, 5, 17, 63}, 64), (std::pair<std::string, int>("5", 64)));
  }
}

TEST(Threads, GoOnAfterAnException) {
  Threads threads(2);
  failureOf(threads, {0, 1}, 2);
  EXPECT_EQ(failureOf(threads, {}, 100).second, 100);
}

TEST(Threads, MayBecomeMoreOrFewer) {
  Threads threads(1);
  for (const int count : {3, 1, 2, 2}) {
    threads.resize(count);
    std::atomic<int> calls = 0;
    threads.forEach(100, [&](int) { ++calls; });

    EXPECT_EQ(threads.count(), count);
    EXPECT_EQ(calls, 100);
  }
}

TEST(Threads, AreAllowedAsTheLauncherSaysAndAtLeastOne) {
  const test::Environment none("SLURM_CPUS_PER_TASK", std::nullopt), alone("OMPI_COMM_WORLD_LOCAL_SIZE", "1");
  const int all = allowedThreads();
  const auto with = [](const char* name, const char* value) {
    const test::Environment launcher(name, value);
    return allowedThreads();
  };

  EXPECT_EQ(with("OMPI_COMM_WORLD_LOCAL_SIZE", "100000"), 1);
  EXPECT_EQ(with("SLURM_CPUS_PER_TASK", "1"), 1);
  EXPECT_EQ(with("SLURM_CPUS_PER_TASK", "0"), all);
  EXPECT_EQ(with("SLURM_CPUS_PER_TASK", "100000"), all);
}

TEST(Threads, WorkThatIsCalledOnceMayRunLoopsWhoseTimeCountsOnce) {
  Threads threads(2);
  std::atomic<int> calls = 0;
  const auto spin = [&](int) {
    const auto end = trace::Clock::now() + std::chrono::milliseconds(2);
    while (trace::Clock::now() < end) continue;
    ++calls;
  };
  const auto start = trace::Clock::now();

  threads.alone([&] { threads.forEach(4, spin); }, trace::Kind::task, "outer");

  const double wall = std::chrono::duration<double>(trace::Clock::now() - start).count();
  EXPECT_EQ(calls, 4);
  EXPECT_LE(threads.use().loops, wall);
  EXPECT_LE(threads.use().task, 2 * wall);
  EXPECT_GE(threads.use().task, 4 * .002);
}

}  // namespace tushar
