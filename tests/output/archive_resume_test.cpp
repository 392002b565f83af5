#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "core/output/archive.hpp"
#include "core/output/archive_cut.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

const ArchiveOptions options{};

void advance(Archive& archive, int firstStep, int lastStep) {
  for (int step = firstStep; step <= lastStep; ++step) {
    const double time = 0.1 * step;
    archive.appendGlobal({"KineticEnergy", "J", "energy of motion", time, {1.5 * step}});
    archive.appendGlobal({"TotalMomentum", "kg m/s", "momentum", time, {1, 2, time}});
    if (step % 2 == 0) archive.write(snapshot3d(step, time));
  }
}

/// Returns the content of each file of a folder by name; for HDF5 files, which record their creation time, the size.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const bool heavy = entry.path().extension() == ".h5";
    files[entry.path().filename()] = heavy ? std::to_string(text.str().size()) : text.str();
  }
  return files;
}

/// Returns the state at step 4 of an archive that reached step 7.
ArchivePoint runToStep7(const fs::path& filebase) {
  Archive archive(filebase, "<scene/>", options);
  advance(archive, 0, 4);
  const ArchivePoint point = archive.pointAt(4, 0.1 * 4);
  advance(archive, 5, 7);
  return point;
}

std::map<std::string, std::string> uncut(const fs::path& filebase) {
  Archive archive(filebase, "<scene/>", options);
  advance(archive, 0, 9);
  archive.flush();
  return contents(archive.folder());
}

std::map<std::string, std::string> goneOn(const fs::path& folder, const ArchivePoint& point) {
  Archive archive(folder, "sod.uda", point, "<scene/>", options);
  EXPECT_EQ(archive.lastStep(), 4);
  EXPECT_FALSE(fs::exists(folder / "t00006.h5"));
  advance(archive, 5, 9);
  archive.flush();
  return contents(folder);
}

}  // namespace

TEST(ArchiveResume, EndsWithTheFilesOfARunThatWasNotCut) {
  const TemporaryFolder here;
  const auto expected = uncut(here / "other/sod.uda");
  const ArchivePoint point = runToStep7(here / "sod.uda");

  EXPECT_EQ(goneOn(here / "sod.uda.000", point), expected);
}

TEST(ArchiveResume, TakesThePointsIndexWhereThatOfTheFolderIsDamaged) {
  const TemporaryFolder here;
  const auto expected = uncut(here / "other/sod.uda");
  const ArchivePoint point = runToStep7(here / "sod.uda");
  fs::resize_file(here / "sod.uda.000/index.xml", 100);
  fs::remove(here / "sod.uda.000/sod.xdmf");

  EXPECT_EQ(goneOn(here / "sod.uda.000", point), expected);
}

/// The folder has its old index, which is complete, as after a power failure.
TEST(ArchiveResume, TakesThePointsIndexWhereThatOfTheFolderIsBehindIt) {
  const TemporaryFolder here;
  const auto expected = uncut(here / "other/sod.uda");
  {
    Archive archive(here / "old/sod.uda", "<scene/>", options);
    advance(archive, 0, 2);
  }
  const ArchivePoint point = runToStep7(here / "sod.uda");
  for (const char* name : {"index.xml", "sod.xdmf"})
    fs::copy_file(here / "old/sod.uda.000" / name, here / "sod.uda.000" / name, fs::copy_options::overwrite_existing);

  EXPECT_EQ(goneOn(here / "sod.uda.000", point), expected);
}

/// An interrupted run writes its checkpoint before its last output.
TEST(ArchiveResume, KeepsAnOutputOfTheStepThatWasMadeAfterThePoint) {
  const TemporaryFolder here;
  ArchivePoint point;
  {
    Archive archive(here / "sod.uda", "<scene/>", options);
    advance(archive, 0, 3);
    point = archive.pointAt(3, 0.3);
    archive.write(snapshot3d(3, 0.3));
  }
  const Archive archive(here / "sod.uda.000", "sod.uda", point, "<scene/>", options);
  EXPECT_EQ(archive.lastStep(), 3);
  EXPECT_TRUE(fs::exists(archive.folder() / "t00003.h5"));
}

TEST(ArchiveResume, RemovesAnOutputThatNoListKnows) {
  const TemporaryFolder here;
  const ArchivePoint point = runToStep7(here / "sod.uda");
  std::ofstream(here / "sod.uda.000/t00003.h5") << "of a run that was killed";
  const Archive archive(here / "sod.uda.000", "sod.uda", point, "<scene/>", options);
  EXPECT_FALSE(fs::exists(archive.folder() / "t00003.h5"));
  EXPECT_TRUE(fs::exists(archive.folder() / "t00002.h5"));
}

TEST(ArchiveResume, BeginsAGlobalAnewWhoseFileIsGone) {
  const TemporaryFolder here;
  const ArchivePoint point = runToStep7(here / "sod.uda");
  fs::remove(here / "sod.uda.000/KineticEnergy.dat");

  EXPECT_EQ(goneOn(here / "sod.uda.000", point).at("KineticEnergy.dat"),
            "# time [s] KineticEnergy [J]\n0.5 7.5\n0.6000000000000001 9\n0.7000000000000001 10.5\n0.8 12\n0.9 13.5\n");
}

TEST(ArchiveResume, StoresTheSceneWithWhatWasOverridden) {
  const TemporaryFolder here;
  const ArchivePoint point = runToStep7(here / "sod.uda");
  const Archive archive(here / "sod.uda.000", "sod.uda", point, "<scene>longer</scene>", options);

  EXPECT_EQ(contents(archive.folder()).at("input.xml"), "<scene>longer</scene>");
}

TEST(ArchiveResume, SaysWhichGlobalsLackLines) {
  const TemporaryFolder here;
  const ArchivePoint point = runToStep7(here / "sod.uda");
  const fs::path folder = here / "sod.uda.000", file = folder / "KineticEnergy.dat";
  const auto damages = [&] { return Archive(folder, "sod.uda", point, "<scene/>", options).damages(); };
  EXPECT_TRUE(damages().empty());
  fs::remove(file);
  ASSERT_EQ(damages().size(), 1u);
  EXPECT_EQ(damages().front(), file.string() + ": is missing");
}

TEST(ArchiveResume, FindsWhatAFileOfSamplesLacks) {
  const std::string lines = "# time [s]\n0 1\n0.1 2\n0.2 3\n";
  const auto damage = [](const std::string& text, double time) {
    return damageBefore(text, linesUpTo(text, time), time);
  };
  EXPECT_EQ(damage(lines, 0.2), "");
  EXPECT_EQ(damage(lines, 0.15), "") << "the run was ahead of its checkpoint";
  EXPECT_EQ(damage(lines + "0.3 ", 0.2), "") << "a torn line of a killed run";
  EXPECT_EQ(damage(lines, 0.3), "its samples after t = 0.2 s are lost");
  EXPECT_EQ(damage(lines + "0.3 ", 0.3), "its samples after t = 0.2 s are lost");
  EXPECT_EQ(damage("# time [s]\n0 1\nx 2\n0.2 3\n", 0.2),
            "line 3 is no sample, so this line and those after it are lost");
  EXPECT_EQ(damage("# time [s]\n", 0.2), "has no samples");
  EXPECT_EQ(damage("", 0.2), "has no samples");
}

TEST(ArchiveResume, KeepsTheLinesUpToATimeAndNoTornOne) {
  const std::string lines = "# time [s]\n0 1\n0.1 2\n0.30000000000000004 3\n0.4 4\n";
  EXPECT_EQ(linesUpTo(lines, 0.1 * 3), "# time [s]\n0 1\n0.1 2\n0.30000000000000004 3\n");
  EXPECT_EQ(linesUpTo(lines, 0.3), "# time [s]\n0 1\n0.1 2\n");
  EXPECT_EQ(linesUpTo(lines, 9), lines);
  EXPECT_EQ(linesUpTo("# time [s]\n0 1\n0.1 2", 9), "# time [s]\n0 1\n");
  EXPECT_EQ(linesUpTo("# time [s]\n0 1\nx 2\n0.1 3\n", 9), "# time [s]\n0 1\n");
  EXPECT_EQ(linesUpTo("", 9), "");
}

}  // namespace tushar::output
