#include "core/output/behind.hpp"

#include <gtest/gtest.h>

#include <latch>
#include <stdexcept>

namespace tushar::output {

TEST(Behind, DoesJobsInTheirOrderAtOnceOrByItsThread) {
  for (const std::size_t most : {0, 100}) {
    Behind behind;
    behind.setMost(most);
    const auto caller = std::this_thread::get_id();
    std::vector<int> done;
    for (int k = 0; k < 100; ++k)
      behind.put(behind.buffer(40), [&, k] {
        EXPECT_EQ(std::this_thread::get_id() == caller, most == 0);
        done.push_back(k);
      });
    behind.wait();
    EXPECT_TRUE(behind.isDone());
    ASSERT_EQ(done.size(), 100u);
    for (int k = 0; k < 100; ++k) EXPECT_EQ(done[static_cast<std::size_t>(k)], k);
  }
}

TEST(Behind, GoesOnWithItsCallerUntilBuffersHaveNoMoreRoom) {
  Behind behind;
  behind.setMost(100);
  std::latch opened(1);
  const long first = behind.put(behind.buffer(60), [&] { opened.wait(); });
  behind.put(behind.buffer(40), [] {});
  EXPECT_FALSE(behind.isDone());
  EXPECT_EQ(behind.waited(), 0);

  std::thread opener([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    opened.count_down();
  });
  const std::vector<std::byte> more = behind.buffer(60);

  EXPECT_GT(behind.waited(), 0.01);
  behind.waitFor(first);
  behind.wait();
  EXPECT_TRUE(behind.isDone());
  opener.join();
}

TEST(Behind, GivesABufferThatIsLargerThanItsBound) {
  Behind behind;
  behind.setMost(10);
  for (int k = 0; k < 3; ++k) behind.put(behind.buffer(1000), [] {});
  behind.wait();
  EXPECT_TRUE(behind.isDone());
}

TEST(Behind, TellsTheFirstFailureOnceAndLetsLaterJobsGo) {
  for (const std::size_t most : {0, 100}) {
    Behind behind;
    behind.setMost(most);
    bool goesOn = false;
    behind.put({}, [] { throw std::runtime_error("full"); });
    behind.put({}, [&] { goesOn = true; });
    EXPECT_THROW(behind.wait(), std::runtime_error);
    EXPECT_FALSE(goesOn);
    EXPECT_NO_THROW(behind.wait());
    behind.put({}, [&] { goesOn = true; });
    behind.wait();
    EXPECT_TRUE(goesOn);
  }
}

TEST(Behind, DoesWhatIsLeftWhenItIsDestroyed) {
  int done = 0;
  {
    Behind behind;
    behind.setMost(1000);
    for (int k = 0; k < 50; ++k) behind.put(behind.buffer(10), [&] { ++done; });
  }
  EXPECT_EQ(done, 50);
}

}  // namespace tushar::output
