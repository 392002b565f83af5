#include "core/simulation/checkpoint_control.hpp"

#include <gtest/gtest.h>

namespace tushar::simulation {

TEST(CheckpointControl, CountsSteps) {
  CheckpointSettings settings;
  settings.timestepInterval = 10;
  const CheckpointControl control(settings, 0);

  EXPECT_TRUE(control.isDue(20, 1e9, 1e9));
  EXPECT_FALSE(control.isDue(21, 1e9, 1e9));
}

TEST(CheckpointControl, CountsTimeFromTheStartOfTheSceneOn) {
  CheckpointSettings settings;
  settings.interval = 0.1;
  CheckpointControl control(settings, 5);
  control.note(5, 0);

  EXPECT_FALSE(control.isDue(3, 5.09, 0));
  EXPECT_TRUE(control.isDue(3, 5.1, 0));
  control.note(5.37, 0);
  EXPECT_FALSE(control.isDue(4, 5.39, 0));
  EXPECT_TRUE(control.isDue(4, 5.4, 0));
}

TEST(CheckpointControl, CountsWallTimeFromTheLastOneOn) {
  CheckpointSettings settings;
  settings.walltimeInterval = 60;
  CheckpointControl control(settings, 0);
  control.note(0, 0.1);

  EXPECT_FALSE(control.isDue(1, 1, 59));
  EXPECT_TRUE(control.isDue(1, 1, 61));
  control.note(1, 65);
  EXPECT_FALSE(control.isDue(2, 2, 124));
  EXPECT_TRUE(control.isDue(2, 2, 125));
}

TEST(CheckpointControl, BeginsWithTheWallTimeThatIsAskedForAndReadsHours) {
  CheckpointSettings settings;
  settings.walltimeStartHours = 2;
  settings.walltimeIntervalHours = 0.5;
  CheckpointControl control(settings, 0);

  EXPECT_FALSE(control.isDue(1, 1, 7199));
  EXPECT_TRUE(control.isDue(1, 1, 7200));
  control.note(1, 7200);
  EXPECT_TRUE(control.isDue(2, 2, 9000));
}

TEST(CheckpointControl, TakesAnIntervalOfWallTimeFromTheCommandLine) {
  std::optional<CheckpointSettings> none;
  addWallTimeInterval(none, 600);
  EXPECT_EQ(none.value().cycle, 2);
  const CheckpointControl alone(*none, 0);
  EXPECT_FALSE(alone.isDue(1, 1, 599));
  EXPECT_TRUE(alone.isDue(1, 1, 600));

  std::optional<CheckpointSettings> both(std::in_place);
  both->timestepInterval = 5;
  both->walltimeIntervalHours = both->walltimeStartHours = 1;
  addWallTimeInterval(both, 60);
  const CheckpointControl beside(*both, 0);
  EXPECT_TRUE(beside.isDue(5, 1, 0));
  EXPECT_FALSE(beside.isDue(6, 1, 59));
  EXPECT_TRUE(beside.isDue(6, 1, 60));
}

TEST(Milestones, ArePassedOneAfterTheOther) {
  Milestones outputs(-1, 0.25);
  EXPECT_EQ(outputs.next(), -0.75);
  outputs.pass(-1);
  EXPECT_FALSE(outputs.isReached(-0.76));
  EXPECT_TRUE(outputs.isReached(-0.75));
  outputs.pass(0.1);
  EXPECT_EQ(outputs.next(), 0.25);
}

TEST(Milestones, ArePassedAtOnceHoweverManyThereAre) {
  Milestones outputs(0, 1e-9);
  outputs.pass(1);
  EXPECT_NEAR(outputs.next(), 1 + 1e-9, 2e-12);

  Milestones tiny(0, 1e-30);
  tiny.pass(1);
  EXPECT_TRUE(tiny.isReached(1.1));
}

TEST(Milestones, ArePassedByATimeThatRoundingKeepsBelow) {
  Milestones outputs(-0.15, 0.05);
  outputs.pass(-0.1 - 1e-16);
  EXPECT_NEAR(outputs.next(), -0.05, 1e-15);
}

TEST(Milestones, OfNoIntervalAreNeverReached) {
  Milestones none(0, 0);
  none.pass(1e300);
  EXPECT_FALSE(none.isReached(1e300));
}

}  // namespace tushar::simulation
