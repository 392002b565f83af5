#include "core/scene/find_restart.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <random>
#include <sstream>

#include "components/components.hpp"
#include "core/base/error.hpp"
#include "core/output/checkpoint_manifest.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::scene {

namespace fs = std::filesystem;
using simulation::Problem;
using simulation::Restart;
using simulation::RunOptions;
using simulation::Simulation;

namespace {

/// Creates an archive with checkpoints of steps 4 and 6.
fs::path archiveWithTwo() {
  Problem problem = readScene("ups/mpm/sod.ups",
                              {"Time/max_Timesteps=6", "DataArchiver/checkpoint/@timestepInterval=4"}, catalogue());
  RunOptions options;
  options.quiet = true;
  options.outputFolder = test::temporaryFolder();
  return Simulation(std::move(problem), options, std::chrono::steady_clock::now()).run().archive;
}

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

/// Flips the bits of `mask` in one byte of a file.
void flip(const fs::path& file, std::size_t at, int mask) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(at));
  const int byte = stream.get();
  stream.seekp(static_cast<std::streamoff>(at));
  stream.put(static_cast<char>(byte ^ mask));
}

}  // namespace

TEST(Restart, SeesEachTruncationOfACheckpointAndTakesTheOneBefore) {
  const fs::path archive = archiveWithTwo();
  const fs::path newest = archive / "checkpoints/t00006";
  EXPECT_EQ(findRestart(archive.string(), {}).step, 6);

  for (const char* name : {"state.h5", "manifest"}) {
    const std::string whole = read(newest / name);
    for (std::size_t size = 0; size < whole.size(); size += std::min<std::size_t>(4096, whole.size() / 2)) {
      write(newest / name, whole.substr(0, size));
      const Restart restart = findRestart(archive.string(), {});
      EXPECT_EQ(restart.step, 4) << name << " " << size;
      EXPECT_EQ(restart.notes.size(), 1u);
    }
    write(newest / name, whole);
  }
}

TEST(Restart, SeesAnyOf1000FlippedBytes) {
  const fs::path archive = archiveWithTwo();
  const fs::path newest = archive / "checkpoints/t00006";
  std::mt19937 chance(7);
  for (const char* name : {"state.h5", "manifest"}) {
    const std::size_t size = fs::file_size(newest / name);
    for (int k = 0; k < 500; ++k) {
      const std::size_t at = chance() % size;
      const int mask = static_cast<int>(1 + chance() % 255);
      flip(newest / name, at, mask);
      EXPECT_EQ(findRestart(archive.string(), {}).step, 4) << name;
      flip(newest / name, at, mask);
    }
  }
  EXPECT_EQ(findRestart(archive.string(), {}).step, 6);
}

TEST(Restart, TakesAWholeCheckpointWhateverHappensToLatest) {
  const fs::path archive = archiveWithTwo();
  const fs::path latest = archive / "checkpoints/LATEST";
  for (std::size_t k = 0; k < fs::file_size(latest); ++k)
    for (int bit = 0; bit < 8; ++bit) {
      flip(latest, k, 1 << bit);
      const int step = findRestart(archive.string(), {}).step;
      EXPECT_TRUE(step == 6 || step == 4) << read(latest);
      flip(latest, k, 1 << bit);
    }
}

TEST(Restart, RefusesADamagedCheckpointThatIsAskedForAndSaysWhichThereAre) {
  const fs::path archive = archiveWithTwo();
  fs::remove(archive / "checkpoints/t00006/manifest");
  try {
    findRestart(archive.string(), 6);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("t00006 is damaged: manifest is missing; available: steps 4, 6"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace tushar::scene
