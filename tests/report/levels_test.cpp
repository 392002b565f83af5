#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/report/report.hpp"

namespace tushar::report {

namespace {

Report refined() {
  Report report;
  report.levels = {40, 30, 100};
  report.dimension = 2;
  report.updates = 123456;
  report.uniformUpdates = 4 * 123456;
  report.regrids = 3;
  report.wallRegrid = 0.25;
  return report;
}

}  // namespace

TEST(Levels, AreInTheReportOfARefinedGrid) {
  const auto json = nlohmann::json::parse(toJson(refined()));
  EXPECT_EQ(json["levels"], (std::vector<long>{40, 30, 100}));
  EXPECT_EQ(json["updates"], 123456);
  EXPECT_EQ(json["uniform_updates"], 4 * 123456);
  EXPECT_EQ(json["regrids"], 3);
  EXPECT_EQ(json["wall"]["regrid"], 0.25);
  const std::string text = toText(refined());
  EXPECT_NE(text.find("cells of 3 levels: 40 + 30 + 100; 1.235e+05 cell updates, 3 regrids\n"
                      "a uniform grid of the finest cells would need 4.938e+05 cell updates, 4 times as many\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("regridding                             250.00\n"), std::string::npos) << text;
}

TEST(Levels, HaveTheirUpdatesInTheReportWhereEachTakesItsOwnSteps) {
  Report report = refined();
  EXPECT_FALSE(nlohmann::json::parse(toJson(report)).contains("level_updates"));
  report.levelUpdates = {10, 2500, 120946};
  EXPECT_EQ(nlohmann::json::parse(toJson(report))["level_updates"], report.levelUpdates);
  const std::string line = "3 regrids\n  cell updates by level, each with its own time steps: 10 + 2500 + 1.209e+05\n";
  EXPECT_NE(toText(report).find(line), std::string::npos) << toText(report);
}

TEST(Levels, TheReportSaysWhereRefinementDoesNotPay) {
  const std::string advice = "  it would probably be faster, because an update takes about ";
  Report report = refined();
  EXPECT_EQ(toText(report).find(advice), std::string::npos);
  report.dimension = 1;
  EXPECT_NE(toText(report).find("4 times as many\n" + advice + "7 times as long on several levels\n"),
            std::string::npos);
  report.dimension = 3;
  EXPECT_EQ(toText(report).find(advice), std::string::npos);
  report.uniformUpdates = 1.5 * report.updates;
  EXPECT_NE(toText(report).find("1.5 times as many\n" + advice + "1.6 times as long on several levels\n"),
            std::string::npos);
}

TEST(Levels, AreNotToldOfWhereThereIsOne) {
  for (const std::vector<long>& levels : {std::vector<long>{}, std::vector<long>{40}}) {
    Report report = refined();
    report.levels = levels;
    const auto json = nlohmann::json::parse(toJson(report));
    for (const char* key : {"levels", "updates", "uniform_updates", "regrids"}) EXPECT_FALSE(json.contains(key)) << key;
    EXPECT_FALSE(json["wall"].contains("regrid"));
    EXPECT_EQ(toText(report).find("regrid"), std::string::npos);
  }
}

}  // namespace tushar::report
