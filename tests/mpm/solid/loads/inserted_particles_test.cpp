#include "components/mpm/solid/loads/inserted_particles.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temporary.hpp"

namespace tushar::mpm::solid {
namespace {

using Sentences = std::vector<std::string>;

struct File {
  std::string path = test::temporaryFolder() + "inserted_particles.dat";
  explicit File(const std::string& text) { std::ofstream(path) << text; }
  ~File() { std::filesystem::remove(path); }
};

/// Returns the messages about a file, each with its line.
Sentences problemsOf(const std::string& text) {
  const File file(text);
  input::Diagnostics diagnostics;
  readInsertions(file.path, {"scene.ups", 3, 1}, diagnostics);
  Sentences found;
  for (const InputProblem& problem : diagnostics.sorted())
    found.push_back(std::to_string(problem.where.line) + ": " + problem.sentence);
  return found;
}

TEST(InsertedParticles, AreReadFromLinesOf8Numbers) {
  const File file("0.5 2 -.175 -1.25 0 20 0 1e1\n\n1 3 0 0 0 0 0 0\n");
  input::Diagnostics diagnostics;

  const std::vector<Insertion> read = readInsertions(file.path, {}, diagnostics);

  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].time, 0.5);
  EXPECT_EQ(read[0].color, 2);
  EXPECT_EQ(read[0].shift, Vec3(-0.175, -1.25, 0));
  EXPECT_EQ(read[0].velocity, Vec3(20, 0, 10));
  EXPECT_EQ(read[1].color, 3);
}

TEST(InsertedParticles, EnterInTheStepThatBeginsAtTheirTimeOrContainsIt) {
  const Insertion insertion{.time = 0.5};

  EXPECT_TRUE(insertion.isIn(0.5, 0.125));
  EXPECT_TRUE(insertion.isIn(0.4375, 0.125));
  EXPECT_FALSE(insertion.isIn(0.375, 0.125));
  EXPECT_FALSE(insertion.isIn(0.625, 0.125));
}

TEST(InsertedParticles, RefuseOtherLinesAndMissingFiles) {
  EXPECT_EQ(problemsOf("0 1 0 0 0 1 0 0\n0 1 0 0\n"),
            Sentences{"2: found 4 numbers, expected 8: time, color, 3 components of the shift, 3 of the new velocity"});
  EXPECT_EQ(problemsOf("0 1 0 0 0 1 0 east\n"), Sentences{"1: found 'east', expected a number"});
  input::Diagnostics diagnostics;
  readInsertions("no/such.dat", {"scene.ups", 3, 1}, diagnostics);
  ASSERT_EQ(diagnostics.sorted().size(), 1u);
  EXPECT_EQ(diagnostics.sorted().front().sentence, "'no/such.dat' cannot be read: there is no such file");
}

}  // namespace
}  // namespace tushar::mpm::solid
