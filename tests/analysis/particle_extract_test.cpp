#include "components/analysis/particle_extract.hpp"

#include <gtest/gtest.h>

namespace tushar::analysis {
namespace {

std::vector<output::Array> arrays() {
  return {{"p.x", "m", "", 3, std::vector<double>{0, 0, 0, .25, .5, -1}},
          {"p.loadCurveID", "1", "", 1, std::vector<std::int32_t>{3, 4}},
          {"p.velocity", "m/s", "", 3, std::vector<double>{0, 0, 0, 1, 2, 3}},
          {"p.stress", "Pa", "", 9, std::vector<double>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}};
}

TEST(ParticleExtract, NamesTheColumnsAsUintahDoes) {
  const std::vector<output::Array> all = arrays();
  EXPECT_EQ(
      extractHeader({all.begin(), all.end()}),
      "# Time    X      Y      Z          p.loadCurveID     p.velocity.x      p.velocity.y      p.velocity.z"
      "     p.stress(0,0)      p.stress(0,1)      p.stress(0,2)     p.stress(1,0)      p.stress(1,1)      p.stress(1,2)"
      "     p.stress(2,0)      p.stress(2,1)      p.stress(2,2)\n");
}

TEST(ParticleExtract, WritesTimePlaceAndVariablesOfOneParticle) {
  const std::vector<output::Array> all = arrays();
  EXPECT_EQ(extractLine(0.5, {all.begin(), all.begin() + 2}, 1),
            "5.000000E-01\t 2.500000E-01\t 5.000000E-01\t -1.000000E+00\t    4\n");
  const std::string line = extractLine(0.5, {all.begin(), all.end()}, 1);
  EXPECT_EQ(std::count(line.begin(), line.end(), 'E'), 1 + 3 + 3 + 9);
  EXPECT_TRUE(line.ends_with("9.000000E+00\n"));
}

}  // namespace
}  // namespace tushar::analysis
