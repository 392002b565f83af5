#include "core/output/checkpoint_store.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fstream>

#include "core/base/error.hpp"
#include "core/output/checkpoint_manifest.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

/// Writes two files into a checkpoint.
std::vector<FilePart> fill(const fs::path& folder) {
  write(folder / "state.h5", std::string(10000, 's'));
  write(folder / "input.xml", "<scene/>");
  return {};
}

std::vector<int> stepsAfterWriting(const CheckpointStore& store, const std::vector<int>& steps) {
  for (const int step : steps) store.write(step, fill);
  return store.steps();
}

}  // namespace

TEST(CheckpointStore, KeepsTheLastOnesAndNamesTheLatest) {
  const TemporaryFolder here;
  const CheckpointStore two(here, 2);
  EXPECT_EQ(two.latest(), -1);
  EXPECT_EQ(stepsAfterWriting(two, {0, 10, 200000}), (std::vector<int>{10, 200000}));
  EXPECT_EQ(two.latest(), 200000);
  EXPECT_EQ(read(here / "checkpoints/LATEST"), "t200000\n");
  EXPECT_EQ(stepsAfterWriting(CheckpointStore(here, 1), {200001}), (std::vector<int>{200001}));
}

TEST(CheckpointStore, KeepsTheLastOneOnTheDiskUntilAnotherIs) {
  const TemporaryFolder here;
  const CheckpointStore store(here, 2);
  store.write(1, fill);

  for (const int step : {2, 3, 4}) store.write(step, fill, {.waitsForDisk = false, .lastOnDisk = 1});

  EXPECT_EQ(store.steps(), (std::vector<int>{1, 3, 4}));
  EXPECT_EQ(store.latest(), 4);
  EXPECT_EQ(damageOf(store.folder(4)), "");
  store.bringToDisk(4);
  EXPECT_EQ(store.steps(), (std::vector<int>{3, 4}));
  EXPECT_EQ(store.latest(), 4);
}

TEST(CheckpointStore, GoesBackAndForgetsWhatCameAfter) {
  const TemporaryFolder here;
  const CheckpointStore store(here, 3);
  stepsAfterWriting(store, {1, 2, 3});

  store.goBackTo(2);

  EXPECT_EQ(store.latest(), 2);
  EXPECT_EQ(store.steps(), (std::vector<int>{1, 2}));
}

TEST(CheckpointStore, TakesTheLastWhereLatestIsLostOrNamesNone) {
  const TemporaryFolder here;
  const CheckpointStore store(here, 3);
  stepsAfterWriting(store, {1, 2});
  for (const char* text : {"", "t00009\n", "t00002x\n", "x"}) {
    write(here / "checkpoints/LATEST", text);
    EXPECT_EQ(store.latest(), 2) << text;
  }
  fs::remove(here / "checkpoints/LATEST");
  EXPECT_EQ(store.latest(), 2);
}

TEST(CheckpointStore, LeavesTheOneBeforeWhereAWriteFails) {
  const TemporaryFolder here;
  const CheckpointStore store(here, 1);
  store.write(1, fill);

  const auto failing = [](const fs::path& folder) -> std::vector<FilePart> {
    fill(folder);
    throw FileError("the disk is full");
  };

  EXPECT_THROW(store.write(2, failing), FileError);
  EXPECT_EQ(store.latest(), 1);
  EXPECT_EQ(damageOf(store.folder(1)), "");
  EXPECT_FALSE(fs::exists(here / "checkpoints/t00002.tmp"));
}

TEST(CheckpointStore, TakesNoHalfWrittenFolderForACheckpointAndClearsItAway) {
  const TemporaryFolder here;
  const CheckpointStore store(here, 2);
  store.write(1, fill);
  fs::create_directories(here / "checkpoints/t00002.tmp");
  write(here / "checkpoints/t00002.tmp/state.h5", "half");

  EXPECT_EQ(store.steps(), (std::vector<int>{1}));
  store.write(2, fill);
  EXPECT_EQ(damageOf(store.folder(2)), "");
  EXPECT_FALSE(fs::exists(here / "checkpoints/t00002.tmp"));
}

TEST(CheckpointManifest, NamesEveryKindOfDamage) {
  const TemporaryFolder here;
  const CheckpointStore store(here, 9);
  const auto damage = [&](int step, const auto& harm) {
    store.write(step, fill);
    harm(store.folder(step));
    return damageOf(store.folder(step));
  };

  EXPECT_EQ(damage(1, [](const fs::path&) {}), "");
  EXPECT_EQ(damage(2, [](const fs::path& at) { fs::resize_file(at / "state.h5", 4096); }),
            "state.h5 has 4096 bytes instead of 10000");
  EXPECT_EQ(damage(3, [](const fs::path& at) { write(at / "state.h5", std::string(10000, 't')); }),
            "the content of state.h5 has changed");
  EXPECT_EQ(damage(4, [](const fs::path& at) { fs::remove(at / "input.xml"); }), "input.xml is missing");
  EXPECT_EQ(damage(5, [](const fs::path& at) { fs::remove(at / "manifest"); }), "manifest is missing");
  EXPECT_EQ(damage(6, [](const fs::path& at) { fs::resize_file(at / "manifest", 0); }),
            "the content of manifest has changed");
}

/// Changes the first line of a manifest and updates its hash.
void changeFormat(const fs::path& manifest, const std::string& format) {
  std::string lines = read(manifest);
  lines = format + lines.substr(lines.find('\n') + 1);
  lines.resize(lines.rfind('\n', lines.size() - 2) + 1);
  write(manifest, lines + fmt::format("{:016x} manifest\n", XXH64(lines.data(), lines.size(), 0)));
}

TEST(CheckpointManifest, IsReadWithoutTheNumberOfItsFormatAndSaysANewerOne) {
  const TemporaryFolder here;
  const CheckpointStore store(here, 1);
  store.write(1, fill);
  const fs::path manifest = store.folder(1) / "manifest";
  EXPECT_TRUE(read(manifest).starts_with("format 3\n"));

  changeFormat(manifest, "");
  EXPECT_EQ(damageOf(store.folder(1)), "");
  changeFormat(manifest, "format 4\ns0 of some other kind\n");
  const Inspection found = inspect(store.folder(1));
  EXPECT_TRUE(found.isNewer);
  EXPECT_EQ(found.damage, "manifest has format 4, but this sus supports only formats up to 3");
  changeFormat(manifest, "format 99999999999999\n");
  EXPECT_EQ(inspect(store.folder(1)).damage,
            "manifest has format 99999999999999, but this sus supports only formats up to 3");
}

TEST(CheckpointManifest, SeesAnyByteOfItsOwnThatIsChangedOrCutOff) {
  const TemporaryFolder here;
  const CheckpointStore store(here, 1);
  store.write(1, fill);
  const fs::path manifest = store.folder(1) / "manifest";
  const std::string text = read(manifest);

  for (std::size_t k = 0; k < text.size(); ++k) {
    std::string changed = text;
    changed[k] = static_cast<char>(changed[k] ^ 1);
    write(manifest, changed);
    EXPECT_NE(damageOf(store.folder(1)), "") << k;
    write(manifest, text.substr(0, k));
    EXPECT_NE(damageOf(store.folder(1)), "") << k;
  }
}

}  // namespace tushar::output
