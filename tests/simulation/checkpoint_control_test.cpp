#include "core/simulation/checkpoint_control.hpp"

#include <gtest/gtest.h>

namespace tushar::simulation {

namespace {

struct Moment {
  int step;
  double time, wallTime;  ///< time and wall time [s]
};

/// Expects that a checkpoint is not yet due at `before`, but due at `after`.
void expectDueBetween(const CheckpointControl& control, const Moment& before, const Moment& after) {
  EXPECT_FALSE(control.isDue(before.step, before.time, before.wallTime));
  EXPECT_TRUE(control.isDue(after.step, after.time, after.wallTime));
}
/// Expects that after a checkpoint at `last` the next one is not yet due at `before`, but due at `after`.
void expectNextBetween(CheckpointControl& control, const Moment& last, const Moment& before, const Moment& after) {
  control.note(last.time, last.wallTime);
  expectDueBetween(control, before, after);
}

}  // namespace

TEST(CheckpointControl, CountsSteps) {
  const CheckpointControl control({.timestepInterval = 10}, 0);
  expectDueBetween(control, {21, 1e9, 1e9}, {20, 1e9, 1e9});
}

TEST(CheckpointControl, CountsTimeFromTheStartOfTheSceneOn) {
  CheckpointControl control({.interval = 0.1}, 5);
  expectNextBetween(control, {0, 5, 0}, {3, 5.09, 0}, {3, 5.1, 0});
  expectNextBetween(control, {3, 5.37, 0}, {4, 5.39, 0}, {4, 5.4, 0});
}

TEST(CheckpointControl, CountsWallTimeFromTheLastOneOn) {
  CheckpointControl control({.walltimeInterval = 60}, 0);
  expectNextBetween(control, {0, 0, 0.1}, {1, 1, 59}, {1, 1, 61});
  expectNextBetween(control, {1, 1, 65}, {2, 2, 124}, {2, 2, 125});
}

TEST(CheckpointControl, BeginsWithTheWallTimeThatIsAskedForAndReadsHours) {
  CheckpointControl control({.walltimeStartHours = 2, .walltimeIntervalHours = 0.5}, 0);
  expectDueBetween(control, {1, 1, 7199}, {1, 1, 7200});
  control.note(1, 7200);
  EXPECT_TRUE(control.isDue(2, 2, 9000));
}

TEST(CheckpointControl, TakesAnIntervalOfWallTimeFromTheCommandLine) {
  std::optional<CheckpointSettings> none;
  addWallTimeInterval(none, 600);
  EXPECT_EQ(none.value().cycle, 2);
  expectDueBetween(CheckpointControl(*none, 0), {1, 1, 599}, {1, 1, 600});

  std::optional<CheckpointSettings> both(std::in_place);
  both->timestepInterval = 5;
  both->walltimeIntervalHours = both->walltimeStartHours = 1;
  addWallTimeInterval(both, 60);
  const CheckpointControl beside(*both, 0);
  EXPECT_TRUE(beside.isDue(5, 1, 0));
  expectDueBetween(beside, {6, 1, 59}, {6, 1, 60});
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
