#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/report/report.hpp"

namespace tushar::report {

namespace {

Report refined() {
  Report report;
  report.levels = {40, 30, 100};
  report.updates = 123456;
  report.regrids = 3;
  report.wallRegrid = 0.25;
  return report;
}

}  // namespace

TEST(Levels, AreInTheReportOfARefinedGrid) {
  const auto json = nlohmann::json::parse(toJson(refined()));
  EXPECT_EQ(json["levels"], (std::vector<long>{40, 30, 100}));
  EXPECT_EQ(json["updates"], 123456);
  EXPECT_EQ(json["regrids"], 3);
  EXPECT_EQ(json["wall"]["regrid"], 0.25);
  const std::string text = toText(refined());
  EXPECT_NE(text.find("cells of 3 levels: 40 + 30 + 100; 1.235e+05 cell updates, 3 regrids\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("regridding                             250.00\n"), std::string::npos) << text;
}

TEST(Levels, AreNotToldOfWhereThereIsOne) {
  for (const std::vector<long>& levels : {std::vector<long>{}, std::vector<long>{40}}) {
    Report report = refined();
    report.levels = levels;
    const auto json = nlohmann::json::parse(toJson(report));
    for (const char* key : {"levels", "updates", "regrids"}) EXPECT_FALSE(json.contains(key)) << key;
    EXPECT_FALSE(json["wall"].contains("regrid"));
    EXPECT_EQ(toText(report).find("regrid"), std::string::npos);
  }
}

}  // namespace tushar::report
