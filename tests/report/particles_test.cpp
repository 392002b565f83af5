#include <gtest/gtest.h>

#include "core/report/report.hpp"

namespace tushar::report {

TEST(Particles, ThatLeftTheGridAreInTheReportThoughNoneRemain) {
  Report report;
  report.particles = 3;
  report.dropped = 2;
  EXPECT_NE(toText(report).find(", 3 particles (2 left the grid)"), std::string::npos) << toText(report);
  report.particles = 0;
  report.dropped = 5;
  EXPECT_NE(toText(report).find(", 0 particles (5 left the grid)"), std::string::npos) << toText(report);
  report.removed = 2;
  EXPECT_NE(
      toText(report).find(
          "(5 left the grid, 2 removed: turned inside out, deformed too much or thrown through a symmetry plane)"),
      std::string::npos)
      << toText(report);
  report.dropped = report.removed = 0;
  EXPECT_EQ(toText(report).find("particle"), std::string::npos) << toText(report);
}

}  // namespace tushar::report
