#include "core/report/problems.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace tushar::report {

TEST(ProblemsAsJson, HavePlaceMessageAndTheNearestWord) {
  const auto list = nlohmann::json::parse(toJson({{{"s.ups", 3, 7}, "Time/maxTime", "found 'x', expected a number"},
                                                  {{"--set a=1", 0, 0}, "", "unknown tag <a> (did you mean 'b'?)"}}));
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0], (nlohmann::json{{"file", "s.ups"},
                                     {"line", 3},
                                     {"column", 7},
                                     {"path", "Time/maxTime"},
                                     {"message", "found 'x', expected a number"}}));
  EXPECT_EQ(list[1]["suggestion"], "b");
}

TEST(ProblemsAsJson, AreAnEmptyListWhereThereAreNone) { EXPECT_EQ(toJson(std::vector<InputProblem>{}), "[]\n"); }

}  // namespace tushar::report
