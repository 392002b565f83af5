#include "core/output/run_log.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace {

using Json = nlohmann::json;

RunRecord record() {
  RunRecord record;
  record.version = "1.2";
  record.commit = "0123456789ab";
  record.libraries = {{"HDF5", "1.10.8"}};
  record.command = {"sus", "a \"scene\".ups"};
  record.overrides = {"Time/maxTime=1"};
  record.ranks = 3;
  return record;
}

Json runsIn(const TemporaryFolder& folder) { return Json::parse(read(folder / "run.json")); }

}  // namespace

TEST(RunLog, TellsProgramAndCommandLineFromTheStart) {
  const TemporaryFolder here;
  const RunLog log(here, record());
  const Json all = runsIn(here), run = all["runs"].at(0);
  EXPECT_EQ(all["format"], 3);
  EXPECT_EQ(run["commit"], "0123456789ab");
  EXPECT_EQ(run["libraries"]["HDF5"], "1.10.8");
  EXPECT_EQ(run["command"], Json({"sus", "a \"scene\".ups"}));
  EXPECT_EQ(run["overrides"], Json({"Time/maxTime=1"}));
  EXPECT_EQ(run["ranks"], 3);
  EXPECT_EQ(run["started"].get<std::string>().size(), 20u);
  EXPECT_TRUE(run["end"].is_null());
}

TEST(RunLog, AddsEachRestartAndEnd) {
  const TemporaryFolder here;
  RunLog(here, record()).end("max_Timesteps", 7, 0);
  RunRecord again = record();
  again.restarts = true;
  again.step = 7;
  RunLog log(here, again);
  log.addLibrary("PETSc", "3.18");
  log.end("interrupted", 9, 5);
  const Json runs = runsIn(here)["runs"];
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0]["end"]["why"], "max_Timesteps");
  EXPECT_EQ(runs[0]["end"]["step"], 7);
  EXPECT_EQ(runs[0]["restart"], false);
  EXPECT_EQ(runs[1]["from_step"], 7);
  EXPECT_EQ(runs[1]["end"]["exit"], 5);
  EXPECT_EQ(runs[1]["libraries"]["PETSc"], "3.18");
}

TEST(RunLog, NotesARunThatAnErrorEnded) {
  const TemporaryFolder here;
  { const RunLog log(here, record()); }
  EXPECT_EQ(runsIn(here)["runs"][0]["end"]["why"], "error");
  EXPECT_EQ(runsIn(here)["runs"][0]["end"]["exit"], 1);
}

TEST(RunLog, MovesADamagedFileAway) {
  const TemporaryFolder here;
  std::ofstream(here / "run.json") << R"({"runs": [)";
  const RunLog log(here, record());
  EXPECT_EQ(runsIn(here)["runs"].size(), 1u);
  EXPECT_EQ(read(here / "run.json.damaged"), R"({"runs": [)");
}

/// A sus of the older version would report the next checkpoint as damaged.
TEST(RunLog, GivesItsFormatToAnArchiveOfAnOlderVersion) {
  const TemporaryFolder here;
  std::ofstream(here / "run.json") << R"({"format": 1, "runs": [{"end": null}]})";
  const RunLog log(here, record());
  EXPECT_EQ(runsIn(here)["format"], 3);
  EXPECT_EQ(runsIn(here)["runs"].size(), 2u);
}

TEST(RunLog, RefusesAFileOfANewerVersion) {
  EXPECT_EQ(RunLog::refusalOf(R"({"format": 99, "runs": []})"),
            "run.json of the archive has format 99, but this sus supports only formats up to 3");
  EXPECT_EQ(RunLog::refusalOf(R"({"format": 1, "runs": []})"), "");
  EXPECT_EQ(RunLog::refusalOf(R"({"format": 3, "runs": []})"), "");
  EXPECT_EQ(RunLog::refusalOf("{"), "");
  for (const std::string other : {"4.5", "\"4\"", "99999999999999999999"})
    EXPECT_NE(RunLog::refusalOf("{\"format\": " + other + ", \"runs\": []}"), "") << other;
}

}  // namespace tushar::output
