#include "core/simulation/trigger_files.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary.hpp"

namespace tushar::simulation {

namespace fs = std::filesystem;

namespace {

using test::newFolder;

void touch(const fs::path& file) { std::ofstream(file) << ""; }

}  // namespace

TEST(TriggerFiles, AreFoundOnceAndTakenAway) {
  const fs::path folder = newFolder("triggers");
  TriggerFiles files(folder);
  touch(folder / "output_now");

  const TriggerFiles::Found first = files.look(1), second = files.look(2);

  EXPECT_TRUE(first.output);
  EXPECT_FALSE(first.stop);
  EXPECT_FALSE(second.output);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(TriggerFiles, OfAnEarlierRunAskForNothing) {
  const fs::path folder = newFolder("old triggers");
  touch(folder / "stop_now");

  TriggerFiles files(folder);

  EXPECT_FALSE(files.look(1).stop);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(TriggerFiles, AreLookedForTenTimesInASecond) {
  const fs::path folder = newFolder("rare triggers");
  TriggerFiles files(folder);
  files.look(1);
  touch(folder / "stop_now");

  EXPECT_FALSE(files.look(1.05).stop);
  EXPECT_TRUE(files.look(1.15).stop);
}

}  // namespace tushar::simulation
