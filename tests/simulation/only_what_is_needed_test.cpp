#include <dlfcn.h>
#include <gtest/gtest.h>
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <filesystem>

#include "components/components.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/support/temporary.hpp"

// Work that a scene does not request is not done.

namespace tushar::simulation {

using scene::readScene;

namespace {

/// Runs Sod's tube for some steps with or without outputs; returns the folder for its files.
std::string runSod(bool saves, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all{"Time/max_Timesteps=3"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  Problem problem = readScene("ups/mpm/sod.ups", all, catalogue());
  if (!saves) problem.archive.saves.clear();
  RunOptions options;
  options.quiet = true;
  options.outputFolder = test::temporaryFolder() + (saves ? "saves" : "bare");
  std::filesystem::create_directories(options.outputFolder);
  Simulation(std::move(problem), options, std::chrono::steady_clock::now()).run();
  return options.outputFolder;
}

/// Whether HDF5 has been initialised in this process, from its own flag.
bool isHdf5Started() {
  const auto* started = static_cast<const bool*>(dlsym(RTLD_DEFAULT, "H5_libinit_g"));
  EXPECT_NE(started, nullptr) << "this HDF5 does not show its flag";
  return started && *started;
}

}  // namespace

TEST(OnlyWhatIsNeeded, ARunWithoutSaveStartsNoHdf5AndWritesNothing) {
  const bool before = isHdf5Started();  // by another test of this process; ctest gives each its own

  const std::string folder = runSod(false);

  EXPECT_TRUE(std::filesystem::is_empty(folder));
  EXPECT_EQ(isHdf5Started(), before);
}

TEST(OnlyWhatIsNeeded, ARunWithSaveDoesStartHdf5) {
  const std::string folder = runSod(true);

  EXPECT_FALSE(std::filesystem::is_empty(folder));
  EXPECT_TRUE(isHdf5Started());
}

TEST(OnlyWhatIsNeeded, ARunWithoutALauncherDoesNotInitialiseMpi) {
  runSod(true);
  int initialised = 1;

  MPI_Initialized(&initialised);

  EXPECT_EQ(initialised, 0);
}

TEST(OnlyWhatIsNeeded, AVariableThatNobodyReadsIsNeverAllocated) {
  const auto allocations = [](const std::vector<std::string>& overrides) {
    Problem problem = readScene("ups/mpm/sod.ups", overrides, catalogue());
    problem.archive.saves.clear();
    RunOptions options;
    options.quiet = true;
    Simulation run(std::move(problem), options, std::chrono::steady_clock::now());
    run.tryStart();
    const int volume = run.warehouse().table().find("p.volume", 0);
    EXPECT_EQ(volume, -1) << "nothing reads p.volume, so no task of it is bound";
    return run.warehouse().allocations();
  };

  // Without redistribution the start holds x, velocity, density, energy, pressure, mass and ids: 7 allocations.
  EXPECT_EQ(allocations({}), 7u);
}

TEST(OnlyWhatIsNeeded, AParticleOfATubeStoresOneComponentOfEachVector) {
  Problem problem = readScene("ups/mpm/sod.ups", {}, catalogue());
  RunOptions options;
  options.quiet = true;
  problem.archive.saves.clear();
  Simulation run(std::move(problem), options, std::chrono::steady_clock::now());

  const data::VariableTable& table = run.warehouse().table();

  EXPECT_EQ(table[table.find("p.velocity", 0)].label->bytes, sizeof(double));
  EXPECT_EQ(table[table.find("g.velocity", 0)].label->bytes, sizeof(double));
}

}  // namespace tushar::simulation
