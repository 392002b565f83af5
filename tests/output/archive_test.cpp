#include "core/output/archive.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <set>

#include "core/base/error.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "no " << part << " in " << text;
}

std::string sentenceOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "no FileError";
}

/// Limits the size of all files while it exists, like a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

}  // namespace

TEST(Archive, TakesTheNextNumberAboveAllThatExist) {
  const TemporaryFolder here;
  EXPECT_EQ(Archive(here / "sod.uda", "").folder(), here / "sod.uda.000");
  EXPECT_EQ(Archive(here / "sod.uda", "").folder(), here / "sod.uda.001");
  fs::create_directory(here / "sod.uda.007");
  fs::create_directory(here / "sod.uda.old");
  fs::remove_all(here / "sod.uda.000");
  fs::create_directory(here / "sod.uda.2147483647");
  EXPECT_EQ(Archive(here / "sod.uda", "").folder(), here / "sod.uda.008");
}

TEST(Archive, PointsARelativeLinkToTheNewestFolder) {
  const TemporaryFolder here;
  const Archive first(here / "sod.uda", "");
  const Archive second(here / "sod.uda", "");
  EXPECT_EQ(fs::read_symlink(here / "sod.uda"), "sod.uda.001");
  EXPECT_TRUE(fs::exists(here / "sod.uda" / "index.xml"));
}

TEST(Archive, MakesTheFoldersAboveItsOwn) {
  const TemporaryFolder here;
  EXPECT_EQ(Archive(here / "runs/today/sod.uda/", "").folder(), here / "runs/today/sod.uda.000");
}

TEST(Archive, RefusesANameThatAFolderHas) {
  const TemporaryFolder here;
  fs::create_directory(here / "sod.uda");
  const auto sentence = sentenceOf([&] { Archive(here / "sod.uda", ""); });
  EXPECT_EQ(sentence, "cannot create '" + (here / "sod.uda").string() +
                          "' as a link to the newest archive: there is a folder of that name; move it away");
  EXPECT_FALSE(fs::exists(here / "sod.uda.000"));
}

TEST(Archive, NamesTheFolderThatCannotBeMade) {
  const TemporaryFolder here;
  std::ofstream(here / "file") << "no folder";
  const auto sentence = sentenceOf([&] { Archive(here / "file/sod.uda", ""); });
  EXPECT_EQ(sentence, "cannot make the folder '" + (here / "file").string() + "': Not a directory");
}

TEST(Archive, KeepsTheSceneWordForWord) {
  const TemporaryFolder here;
  const Archive archive(here / "sod.uda", "<Uintah_specification>\n ü </Uintah_specification>\n");
  EXPECT_EQ(read(archive.folder() / "input.xml"), "<Uintah_specification>\n ü </Uintah_specification>\n");
}

TEST(Archive, LeavesNoTemporaryFile) {
  const TemporaryFolder here;
  Archive archive(here / "sod.uda", "");
  archive.appendGlobal({"KineticEnergy", "J", "", 0, {1}});
  archive.write(snapshot3d(0, 0));
  archive.write(snapshot3d(42, 0.5));
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(archive.folder())) names.insert(entry.path().filename());
  const std::set<std::string> expected{"input.xml",  "index.xml",         "sod.xdmf",  "sod.gas.vtkhdf",
                                       "sod.vtkhdf", "KineticEnergy.dat", "t00000.h5", "t00042.h5"};
  EXPECT_EQ(names, expected);
  for (const auto& entry : fs::directory_iterator(here)) EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST(Archive, ListsVariablesGlobalsAndTimesInTheIndex) {
  const TemporaryFolder here;
  Archive archive(here / "sod.uda", "", {.version = "1.2"});
  archive.appendGlobal({"KineticEnergy", "J", "energy of <motion>", 0, {1}});
  archive.write(snapshot3d(42, 0.1));
  const std::string index = read(archive.folder() / "index.xml");
  EXPECT_TRUE(has(index, "<tushar_archive format=\"1\" version=\"1.2\">"));
  EXPECT_TRUE(has(index,
                  "<variable name=\"p.particleID\" centring=\"particle\" type=\"uint64\" components=\"1\" unit=\"\" "
                  "description=\"identity\" materials=\"gas, steel ball\" />"));
  EXPECT_TRUE(has(index, "<variable name=\"c.temperature\" centring=\"cell\""));
  EXPECT_TRUE(has(index,
                  "<global name=\"KineticEnergy\" href=\"KineticEnergy.dat\" components=\"1\" unit=\"J\" "
                  "description=\"energy of &lt;motion"));
  EXPECT_TRUE(has(index, "<timestep href=\"t00042.h5\" time=\"0.1\" delT=\"0.125\">42</timestep>"));
}

/// Readers that support one level only would misread the boxes.
TEST(Archive, HasANewerFormatWhereTheGridIsRefined) {
  const TemporaryFolder here;
  Archive archive(here / "sod.uda", "", {.version = "1.2"});
  archive.write(snapshotRefined(42, 0.1));
  EXPECT_TRUE(has(read(archive.folder() / "index.xml"), "<tushar_archive format=\"2\" version=\"1.2\">"));
}

TEST(Archive, ShowsBoxesAsASpatialCollection) {
  const TemporaryFolder here;
  Archive archive(here / "sod.uda", "");
  archive.write(snapshotRefined(42, 0.1));
  const std::string xdmf = read(archive.folder() / "sod.xdmf");
  EXPECT_TRUE(has(xdmf, "<Grid Name=\"cells at step 42\" GridType=\"Collection\" CollectionType=\"Spatial\">"));
  EXPECT_TRUE(has(xdmf, "<Grid Name=\"level 2 box 3 at step 42\" GridType=\"Uniform\">"));
  EXPECT_TRUE(has(xdmf, "<DataItem Dimensions=\"3 1\" Format=\"XML\">16 1 16</DataItem>"));
  EXPECT_TRUE(has(xdmf, "<DataItem Dimensions=\"3 2\" Format=\"XML\">4 0 1 1 8 3</DataItem>"));
}

TEST(Archive, WritesOneLineOfAGlobalPerSample) {
  const TemporaryFolder here;
  Archive archive(here / "sod.uda", "");
  archive.appendGlobal({"KineticEnergy", "J", "", 0, {1}});
  archive.appendGlobal({"KineticEnergy", "J", "", 0.1, {1.0 / 3}});
  archive.appendGlobal({"TotalMomentum", "kg m/s", "", 0.1, {1, 2, 3}});
  archive.flush();
  EXPECT_EQ(read(archive.folder() / "KineticEnergy.dat"),
            "# time [s] KineticEnergy [J]\n0 1\n0.1 0.3333333333333333\n");
  EXPECT_EQ(read(archive.folder() / "TotalMomentum.dat"),
            "# time [s] TotalMomentum.x [kg m/s] TotalMomentum.y [kg m/s] TotalMomentum.z [kg m/s]\n0.1 1 2 3\n");
  EXPECT_TRUE(has(read(archive.folder() / "index.xml"), "TotalMomentum.dat"));
}

TEST(Archive, KeepsNoLineOfAGlobalInMemory) {
  const TemporaryFolder here;
  Archive archive(here / "sod.uda", "");
  archive.appendGlobal({"Mass", "kg", "", 0, {1}});
  EXPECT_EQ(read(archive.folder() / "Mass.dat"), "# time [s] Mass [kg]\n0 1\n");
  archive.appendGlobal({"Mass", "kg", "", 1, {2}});
  EXPECT_EQ(read(archive.folder() / "Mass.dat"), "# time [s] Mass [kg]\n0 1\n1 2\n");
}

TEST(Archive, ListsANewGlobalAfterTheStep) {
  const TemporaryFolder here;
  Archive archive(here / "sod.uda", "");
  archive.appendGlobal({"Mass", "kg", "", 0, {1}});
  archive.keepUp();
  EXPECT_TRUE(has(read(archive.folder() / "index.xml"), "Mass.dat"));
}

/// If lists were rewritten at every output, the cost of an output would grow with the number of outputs.
TEST(Archive, ListsOutputsNowAndThenAndAllOfThemAtItsEnd) {
  const TemporaryFolder here;
  fs::path folder;
  int replaced = 0;
  {
    Archive archive(here / "sod.uda", "");
    folder = archive.folder();
    std::string before;
    for (int step = 0; step < 50; ++step) {
      archive.write(snapshot3d(step, step));
      if (const std::string now = read(folder / "index.xml"); now != before) ++replaced, before = now;
    }
    EXPECT_TRUE(has(read(folder / "index.xml"), "t00000.h5"));
  }
  EXPECT_LT(replaced, 25);
  EXPECT_TRUE(has(read(folder / "index.xml"), "t00049.h5"));
  EXPECT_TRUE(has(read(folder / "sod.xdmf"), "t00049.h5"));
}

TEST(Archive, RemembersTheLastStep) {
  const TemporaryFolder here;
  Archive archive(here / "sod.uda", "");
  EXPECT_EQ(archive.lastStep(), -1);
  archive.write(snapshot3d(42, 0.1));
  EXPECT_EQ(archive.lastStep(), 42);
}

TEST(Archive, ListsAStepThatIsWrittenAgainOnce) {
  const TemporaryFolder here;
  Archive archive(here / "sod.uda", "");
  archive.write(snapshot3d(42, 0.1));
  archive.write(snapshot3d(42, 0.2));
  archive.flush();
  for (const char* name : {"index.xml", "sod.xdmf"}) {
    const std::string text = read(archive.folder() / name);
    EXPECT_EQ(text.find("\"0.1\""), std::string::npos) << name;
    EXPECT_NE(text.find("\"0.2\""), std::string::npos) << name;
  }
}

/// The disk may become full in the data, in HDF5's own structures, or in the last bytes.
TEST(Archive, SaysWhichOutputAFullDiskRefusedAndGoesOn) {
  const TemporaryFolder here;
  for (const int compression : {0, 4}) {
    Archive archive(here / "sod.uda", "", {.compression = compression});
    Snapshot large = snapshot3d(0, 0);
    large.particles = {particles("gas", 0, 100000, 0)};
    archive.write(large);
    const rlim_t size = fs::file_size(archive.folder() / "t00000.h5");
    const std::string index = read(archive.folder() / "index.xml");
    large.step = 1;
    for (const rlim_t bytes : {rlim_t{0}, rlim_t{100}, rlim_t{3000}, size / 2, size - 1}) {
      std::string sentence;
      {
        const SmallDisk disk(bytes);
        sentence = sentenceOf([&] { archive.write(large); });
      }
      EXPECT_TRUE(has(sentence, (archive.folder() / "t00001.h5.tmp").string() + "': File too large")) << bytes;
      EXPECT_FALSE(fs::exists(archive.folder() / "t00001.h5.tmp"));
      EXPECT_EQ(read(archive.folder() / "index.xml"), index);
    }
    archive.write(large);
    EXPECT_TRUE(fs::exists(archive.folder() / "t00001.h5"));
  }
}

/// For `xdmf_test.py` and `refined_test.py`: if the variable is set, archives are left in that folder.
TEST(Archive, CanBeLeftForOtherReaders) {
  const char* folder = std::getenv("TUSHAR_TEST_ARCHIVE");
  if (!folder) GTEST_SKIP() << "TUSHAR_TEST_ARCHIVE names no folder";
  Archive archive(fs::path(folder) / "sample.uda", "<Uintah_specification/>");
  for (const int step : {0, 10, 42}) {
    Snapshot snapshot = snapshot3d(step, 0.1 * step);
    if (step == 42) snapshot.particles[1] = particles("steel ball", 1, 3, 0);
    archive.write(snapshot);
  }
  Archive refined(fs::path(folder) / "refined.uda", "<Uintah_specification/>");
  refined.write(snapshotUnrefined(0, 0));
  refined.write(snapshotRefined(10, 1));
  refined.write(snapshotRefined(20, 2));
}

}  // namespace tushar::output
