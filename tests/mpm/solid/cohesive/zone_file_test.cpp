#include "components/mpm/solid/cohesive/zone_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary.hpp"

namespace tushar::mpm::solid {

namespace {

/// The zones of a file with this text, for two materials, and the problems found, each with its line.
std::pair<std::vector<CohesiveZone>, std::string> read(const std::string& text) {
  const std::string path = test::temporaryFolder() + "zones.txt";
  std::ofstream(path) << text;
  input::Diagnostics diagnostics;
  const auto zones = readZones(path, {"scene.ups", 3, 4}, 2, diagnostics);
  std::string problems;
  for (const InputProblem& problem : diagnostics.sorted())
    problems += std::to_string(problem.where.line) + ": " + problem.sentence + '\n';
  return {zones, problems};
}

}  // namespace

TEST(ZoneFile, hasAZonePerLine) {
  const auto [zones, problems] = read("1 2 3 .5 0 1.001 0 1 0 0 1 0\n\n4 5 6 1 1 0 0 0 0 1 0 1\n");
  EXPECT_EQ(problems, "");
  ASSERT_EQ(zones.size(), 2U);
  EXPECT_EQ(zones[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(zones[0].area, .5);
  EXPECT_EQ(zones[0].normal, Vec3(0, 1, 0));
  EXPECT_EQ(zones[0].bottom, 1);
  EXPECT_EQ(zones[0].top, 0);
  EXPECT_EQ(zones[1].line, 3);
}

TEST(ZoneFile, namesTheLineOfEachProblem) {
  EXPECT_EQ(read("1 2 3 .5 0 1 0 1 0 0 1 0\n1 2 3 .5 0 1 0 1\n").second,
            "2: found 8 numbers, expected 12: 3 coordinates of the position, the area, 3 components of the normal, 3 "
            "of a tangent, the bottom and the top material\n");
  EXPECT_EQ(read("1 2 3 a 0 1 0 1 0 0 1 0\n").second, "1: found 'a', expected a number\n");
  EXPECT_EQ(read("1 2 3 0 0 1 0 1 0 0 1 0\n").second, "1: the area is 0, expected more than 0\n");
  EXPECT_EQ(read("1 2 3 1 0 2 0 1 0 0 1 0\n").second, "1: the normal has the length 2, expected 1\n");
  EXPECT_EQ(read("1 2 3 1 0 1 0 .6 .8 0 1 0\n").second,
            "1: the tangent is not perpendicular to the normal: their product is 0.8\n");
  EXPECT_EQ(read("1 2 3 1 0 1 0 1 0 0 1 2\n").second,
            "1: there is no material 2; materials are numbered from 0 to 1\n");
  EXPECT_EQ(read("1 2 3 1 0 1 0 1 0 0 .5 1\n").second,
            "1: there is no material 0.5; materials are numbered from 0 to 1\n");
  EXPECT_EQ(read("1 2 3 1 0 1 0 1 0 0 1 1\n").second, "1: the bottom and the top material are both 1\n");
  EXPECT_TRUE(read("\n").second.starts_with("3: ") && read("\n").second.ends_with("contains no zones\n"));
}

}  // namespace tushar::mpm::solid
