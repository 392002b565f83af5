#include "core/simulation/restart.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fstream>

#include "core/base/error.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::simulation {

/// Writes a checkpoint of a step; `manifest` is the content of that file before its own hash.
void writeCheckpoint(const std::filesystem::path& archive, int step, const std::string& manifest) {
  const output::CheckpointStore store(archive, 9);
  store.write(step, [](const std::filesystem::path&) { return std::vector<output::FilePart>(); });
  std::ofstream(store.folder(step) / "manifest")
      << manifest << fmt::format("{:016x} manifest\n", XXH64(manifest.data(), manifest.size(), 0));
}

/// Otherwise the older checkpoint would be used, and the newer one overwritten.
TEST(Restart, RefusesACheckpointOfANewerVersionThoughAnOlderOneIsWhole) {
  const output::TemporaryFolder here;
  writeCheckpoint(here, 1, "format 3\n");
  writeCheckpoint(here, 2, "format 4\n");
  writeCheckpoint(here, 3, "format 3\nnot its size 7 state.h5\n");
  const mpi::Communicator alone;
  Restart restart{.archive = here, .notes = {}, .others = {2, 1}};
  EXPECT_THROW(takeNext(restart, alone), InputError);
  EXPECT_EQ(restart.step, 2);

  Restart older{.archive = here, .notes = {}, .others = {3, 1}};
  EXPECT_TRUE(takeNext(older, alone));
  EXPECT_EQ(older.step, 1);
  EXPECT_EQ(older.notes.size(), 1u);
}

}  // namespace tushar::simulation
