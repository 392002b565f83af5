#include "core/simulation/time_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"

namespace tushar::simulation {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

TimeSettings until(double maxTime) {
  TimeSettings settings;
  settings.maxTime = maxTime;
  return settings;
}

/// Returns the message of the NumericalError that `work` throws; empty if it throws none.
template <class Work>
std::string whatOf(Work&& work) {
  try {
    work();
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "";
}

std::string refusal(double stable) {
  TimeControl time(until(1));
  return whatOf([&] { time.next({stable}, never); });
}

}  // namespace

TEST(TimeControl, MultipliesAndBoundsTheStableStep) {
  TimeSettings settings = until(1);
  settings.timestepMultiplier = 0.5;
  settings.deltMin = 0.01;
  settings.deltMax = 0.1;

  EXPECT_EQ(TimeControl(settings).next({0.1}, never), 0.05);
  EXPECT_EQ(TimeControl(settings).next({1e-9}, never), 0.01);
  EXPECT_EQ(TimeControl(settings).next({9}, never), 0.1);
}

TEST(TimeControl, LimitsTheFirstStepAndTheGrowthOfTheOthers) {
  TimeSettings settings = until(1);
  settings.deltInit = 0.001;
  settings.maxDeltIncrease = 1;
  TimeControl time(settings);

  EXPECT_EQ(time.next({0.1}, never), 0.001);
  time.advance();
  EXPECT_EQ(time.next({0.1}, never), 0.002) << "1 more than the step before, as Uintah has it";
}

TEST(TimeControl, KeepsTheFirstStepForAsLongAsAskedBeItBelowTheLeast) {
  TimeControl time({.maxTime = 1, .deltMin = 0.01, .deltInit = 0.001, .initialDeltRange = 0.0015});

  for (const double expected : {0.001, 0.001, 0.1, 0.1}) {
    EXPECT_EQ(time.next({0.1}, never), expected) << "as Uintah has it";
    time.advance();
  }
}

TEST(TimeControl, TakesNoGreatestStepOrGrowthFromZero) {
  TimeControl time({.maxTime = 1, .deltMax = 0, .deltInit = 0.001, .maxDeltIncrease = 0});

  time.next({0.1}, never);
  time.advance();
  EXPECT_EQ(time.next({0.1}, never), 0.1);
}

TEST(TimeControl, EndsAtMaxTimeExactlyAndAtOutputsWhereAsked) {
  TimeSettings settings = until(0.3);
  settings.endAtMaxTimeExactly = settings.clampTimeToOutput = true;
  TimeControl time(settings);

  for (const double output : {0.17, 0.17, 0.5, 0.5}) {
    if (time.done()) break;
    time.next({0.1}, output);
    time.advance();
  }

  EXPECT_TRUE(time.done());
  EXPECT_EQ(time.time(), 0.3);
}

TEST(TimeControl, LeavesNoStepToRoundingAtTheEnd) {
  TimeControl time({.maxTime = 1, .deltMax = 0.1, .endAtMaxTimeExactly = true});
  double least = 1;
  while (!time.done()) {
    least = std::min(least, time.next({never}, never));
    time.advance();
  }
  EXPECT_EQ(time.step(), 10) << "ten times .1 are 1 - 1.1e-16";
  EXPECT_EQ(time.time(), 1);
  EXPECT_GT(least, 0.0999);
}

TEST(TimeControl, TakesAShortStepThatIsNotRounding) {
  TimeControl time({.maxTime = 0.1 + 1e-9, .deltMax = 0.1, .endAtMaxTimeExactly = true});
  time.next({never}, never);
  time.advance();
  EXPECT_FALSE(time.done());
  EXPECT_NEAR(time.next({never}, never), 1e-9, 1e-16);
}

TEST(TimeControl, RunsPastMaxTimeWhereNotAsked) {
  TimeControl time(until(0.25));
  while (!time.done()) {
    time.next({0.1}, never);
    time.advance();
  }

  EXPECT_EQ(time.step(), 3);
  EXPECT_GT(time.time(), 0.25);
}

TEST(TimeControl, StepsToMaxTimeIfNothingLimitsTheStep) {
  TimeControl time({.maxTime = 2});
  time.next({0.5}, never);
  time.advance();
  EXPECT_EQ(time.next({never}, never), 1.5);
  time.advance();

  EXPECT_TRUE(time.done());
  EXPECT_EQ(time.time(), 2);
  EXPECT_EQ(time.limits().count("maxTime"), 1u);
}

TEST(TimeControl, KnowsWhichFractionOfTheRunIsDone) {
  TimeSettings settings = until(3);
  settings.initTime = 1;
  settings.maxTimesteps = 8;
  TimeControl time(settings);
  EXPECT_EQ(time.fractionDone(), 0);
  time.resume(2, 2, 1);
  EXPECT_EQ(time.fractionDone(), 0.5) << "by time";
  time.resume(6, 2, 1);
  EXPECT_EQ(time.fractionDone(), 0.75) << "by steps";
}

TEST(TimeControl, RefusesStepsThatLeadNowhere) {
  EXPECT_EQ(refusal(0), "the time step became 0 s (step 1, time 0 s)");
  EXPECT_EQ(refusal(never), "");  // delt_max bounds it
  TimeSettings settings = until(2);
  settings.initTime = 1;
  TimeControl late(settings);
  EXPECT_THROW(late.next({1e-17}, never), NumericalError);
}

TEST(TimeControl, CountsWhichLimitRuledEachStep) {
  TimeSettings settings = until(1);
  settings.deltInit = 0.001;
  settings.maxDeltIncrease = 49;
  settings.endAtMaxTimeExactly = true;
  TimeControl time(settings);

  while (!time.done()) {
    time.next({0.3, "CFL"}, never);
    time.advance();
  }

  const std::map<data::Reason, int> expected{
      {"delt_init", 1}, {"max_delt_increase", 1}, {"CFL", 3}, {"end_at_max_time_exactly", 1}};
  EXPECT_EQ(time.limits(), expected);
}

TEST(TimeControl, RepeatsAStepFromTheSameTimeWithTheFactorAskedFor) {
  TimeSettings settings = until(1);
  settings.maxDeltIncrease = 1;
  TimeControl time(settings);
  time.next({0.25, "CFL"}, never);

  EXPECT_EQ(time.repeat({0.5, "density"}), 0.125);
  EXPECT_EQ(time.repeat({0.99, "density"}), 0.9 * 0.125);     // at least a tenth less
  EXPECT_EQ(time.repeat({0, "density"}), 0.1 * 0.9 * 0.125);  // at most ten times less
  time.advance();

  EXPECT_EQ(time.step(), 1);
  EXPECT_EQ(time.time(), time.delT());
  EXPECT_EQ(time.retries(), 3);
  EXPECT_EQ(time.limits(), (std::map<data::Reason, int>{{"density", 1}}));
  EXPECT_EQ(time.next({9, "CFL"}, never), 2 * time.delT());
}

TEST(TimeControl, SaysWhyAStepCannotBeRepeatedAnyMore) {
  TimeSettings settings = until(1);
  TimeControl unlimited(settings);
  settings.deltMin = 0.1;
  TimeControl limited(settings);
  unlimited.next({0.25}, never);
  limited.next({0.25}, never);
  limited.repeat({0.5, "density"});
  for (int k = 0; k < 20; ++k) unlimited.repeat({0.5, "density"});

  EXPECT_EQ(whatOf([&] {
              limited.repeat({0.5, "density"});
            }),
            "density would violate its bound unless the time step fell to 0.0625 s, below delt_min = 0.1 s (step 1, "
            "time 0 s)");
  EXPECT_EQ(whatOf([&] {
              unlimited.repeat({0.5, "density"});
            }),
            "density would still violate its bound with a time step of 2.38419e-07 s, after 20 repeats (step 1, time "
            "0 s)");
}

}  // namespace tushar::simulation
