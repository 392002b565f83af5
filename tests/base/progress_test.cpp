#include "core/base/progress.hpp"

#include <gtest/gtest.h>

#include <memory>

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
  progress.live(7, 0.5, 0.01, 2);
  progress.line("saved");
  progress.finish();
  const std::string text = textOf(file);
  EXPECT_EQ(text.find("step      7  t = 0.5          dt = 0.01       25 %, "), 0u) << text;
  EXPECT_NE(text.find(" s left\nsaved\n"), std::string::npos) << text;
  EXPECT_EQ(text.find_first_of("\r\033"), std::string::npos) << text;
}

TEST(Progress, IsNotDueBeforeTheFirstMinuteNorTwiceInOne) {
  const File file = temporary();
  Progress minutes(false, file.get());
  EXPECT_FALSE(minutes.due());
  Progress hours(false, file.get(), std::chrono::hours(1));
  hours.live(1, 0.1, 0.1, 1);
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
