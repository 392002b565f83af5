#include "core/simulation/time_control.hpp"

#include <gtest/gtest.h>

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

std::string refusal(double stable) {
  TimeControl time(until(1));
  try {
    time.next(stable, never);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(TimeControl, MultipliesAndBoundsTheStableStep) {
  TimeSettings settings = until(1);
  settings.timestepMultiplier = 0.5;
  settings.deltMin = 0.01;
  settings.deltMax = 0.1;

  EXPECT_EQ(TimeControl(settings).next(0.1, never), 0.05);
  EXPECT_EQ(TimeControl(settings).next(1e-9, never), 0.01);
  EXPECT_EQ(TimeControl(settings).next(9, never), 0.1);
}

TEST(TimeControl, LimitsTheFirstStepAndTheGrowthOfTheOthers) {
  TimeSettings settings = until(1);
  settings.deltInit = 0.001;
  settings.maxDeltIncrease = 2;
  TimeControl time(settings);

  EXPECT_EQ(time.next(0.1, never), 0.001);
  time.advance();
  EXPECT_EQ(time.next(0.1, never), 0.002);
}

TEST(TimeControl, EndsAtMaxTimeExactlyAndAtOutputsWhereAsked) {
  TimeSettings settings = until(0.3);
  settings.endAtMaxTimeExactly = settings.clampTimeToOutput = true;
  TimeControl time(settings);

  for (const double output : {0.17, 0.17, 0.5, 0.5}) {
    if (time.done()) break;
    time.next(0.1, output);
    time.advance();
  }

  EXPECT_TRUE(time.done());
  EXPECT_EQ(time.time(), 0.3);
}

TEST(TimeControl, RunsPastMaxTimeWhereNotAsked) {
  TimeControl time(until(0.25));
  while (!time.done()) {
    time.next(0.1, never);
    time.advance();
  }

  EXPECT_EQ(time.step(), 3);
  EXPECT_GT(time.time(), 0.25);
}

TEST(TimeControl, RefusesStepsThatLeadNowhere) {
  EXPECT_EQ(refusal(0), "the time step became 0 s (step 1, time 0 s)");
  EXPECT_EQ(refusal(never), "");  // delt_max bounds it
  TimeSettings settings = until(2);
  settings.initTime = 1;
  TimeControl late(settings);
  EXPECT_THROW(late.next(1e-17, never), NumericalError);
}

}  // namespace tushar::simulation
