#include "core/input/diagnostics.hpp"

#include "tests/input/support.hpp"

namespace tushar::input {
namespace {

TEST(Diagnostics, ThrowNothingWhenThereIsNoProblem) {
  const Diagnostics diagnostics;

  EXPECT_FALSE(diagnostics.any());
  EXPECT_NO_THROW(diagnostics.throwIfAny());
}

TEST(Diagnostics, AreSortedByLineWithinTheirFile) {
  Diagnostics diagnostics;
  diagnostics.error({"b.ups", 9, 1}, "A", "third.");
  diagnostics.error({"b.ups", 2, 5}, "B", "second.");
  diagnostics.error({"a.ups", 1, 1}, "C", "fourth.");
  diagnostics.error({"b.ups", 2, 1}, "", "first.");

  const Lines lines = told(diagnostics);

  EXPECT_EQ(lines,
            (Lines{"b.ups:2:1: first.", "b.ups:2:5: B: second.", "b.ups:9:1: A: third.", "a.ups:1:1: C: fourth."}));
}

TEST(Diagnostics, CountReportsOfAKnownProblemToo) {
  Diagnostics diagnostics;
  for (std::size_t k = 1; k < 3; ++k) {
    diagnostics.error(Location{"a.ups", 1, 1}, "", "the section <MaterialProperties> is missing");
    EXPECT_EQ(diagnostics.size(), k);
  }
  EXPECT_EQ(diagnostics.sorted().size(), 1u);
}

TEST(Diagnostics, ThrowAllProblemsAtOnce) {
  const Document document = documentOf("<Time/><Grid/>");
  Diagnostics diagnostics;
  diagnostics.error(*document.root().child("Grid"), "two");
  diagnostics.error(*document.root().child("Time"), "one");

  try {
    diagnostics.throwIfAny();
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 2u);
    EXPECT_STREQ(error.what(), "s.ups:1:24: Time: one\ns.ups:1:31: Grid: two");
  }
}

}  // namespace
}  // namespace tushar::input
