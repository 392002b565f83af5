#include "core/base/progress.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

namespace tushar {

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File temporary() { return {std::tmpfile(), std::fclose}; }

std::string textOf(const File& file) {
  std::rewind(file.get());
  std::string text;
  for (int c; (c = std::fgetc(file.get())) != EOF;) text += static_cast<char>(c);
  return text;
}

}  // namespace

TEST(Progress, GoesToAFileALineAPeriod) {
  const File file = temporary();
  Progress progress(false, file.get(), std::chrono::nanoseconds(1));
  EXPECT_TRUE(progress.due());
  progress.live(7, 0.5, 0.01, 0.25);
  progress.line("saved");
  progress.finish();
  const std::string text = textOf(file);
  EXPECT_EQ(text.find("step      7  t = 0.5          dt = 0.01       25 %, "), 0u) << text;
  EXPECT_NE(text.find(" s left\nsaved\n"), std::string::npos) << text;
  EXPECT_EQ(text.find_first_of("\r\033"), std::string::npos) << text;
}

TEST(Progress, OfARunThatContinuesCountsOnlyItsOwnSteps) {
  const File file = temporary();
  Progress progress(false, file.get());
  progress.begin(0.5);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  progress.live(7, 0.5, 0.01, 0.5 + 1e-4);
  const std::string text = textOf(file);
  const std::size_t at = text.find("%, ");
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_GT(std::stod(text.substr(at + 3)), 0.02 * (0.4999 / 1e-4) - 1) << text;
}

TEST(Progress, IsNotDueBeforeTheFirstMinuteNorTwiceInOne) {
  const File file = temporary();
  Progress minutes(false, file.get());
  EXPECT_FALSE(minutes.due());
  Progress hours(false, file.get(), std::chrono::hours(1));
  hours.live(1, 0.1, 0.1, 0.1);
  EXPECT_FALSE(hours.due());
}

TEST(Progress, IsNeverDueWhereItIsQuiet) {
  const File file = temporary();
  Progress progress(true, file.get(), std::chrono::nanoseconds(1));
  EXPECT_FALSE(progress.due());
  progress.line("saved");
  EXPECT_EQ(textOf(file), "");
}

}  // namespace tushar
