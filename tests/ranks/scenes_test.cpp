#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "components/components.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/ranks/ranks.hpp"

// Results are bitwise equal on any ranks, threads and patches.

namespace tushar::simulation {

using scene::readScene;

namespace {

using test::onRanks;
namespace fs = std::filesystem;

/// Number of steps and fingerprint of a scene, the same on all ranks. `layout` has the patches along x, y, z (on
/// several levels, the blocks of a patch).
std::string resultOf(const std::string& scene, std::vector<std::string> sets, const Index3& layout,
                     const mpi::Communicator& ranks, int threads) {
  sets.push_back("DataArchiver/outputInterval=0");
  grid::Workers workers;
  workers.layout = layout;
  Problem problem = readScene(scene, sets, catalogue(), workers, test::shareOf(ranks));
  problem.threads = threads;
  problem.archive.saves.clear();
  problem.archive.checkpoint.reset();
  RunOptions options;
  options.quiet = true;
  const report::Report report = Simulation(std::move(problem), options, std::chrono::steady_clock::now(), ranks).run();
  return ranks.broadcast(std::to_string(report.steps) + " " + report.fingerprint + " " +
                         std::to_string(report.particles));
}

/// Returns the number of axes along which a scene has several cells.
int dimensionOf(const std::string& scene) { return readScene(scene, {}, catalogue()).grid->dimension(); }

/// Returns four layouts of patches for a scene, with at most as many patches along an axis as cells.
std::vector<Index3> layoutsOf(const std::string& scene) {
  const Problem problem = readScene(scene, {}, catalogue());
  const Index3 most = problem.grid->level().domain().resolution;
  const Index3 last[] = {{{64, 1, 1}}, {{8, 8, 1}}, {{4, 4, 4}}};
  const int axes = problem.grid->dimension();
  std::vector<Index3> layouts;
  for (const Index3& patches :
       {Index3{{1, 1, 1}}, Index3{{2, 1, 1}}, axes == 1 ? Index3{{7, 1, 1}} : Index3{{1, 7, 1}}, last[axes - 1]})
    layouts.push_back({{std::min(patches[0], most[0]), std::min(patches[1], most[1]), std::min(patches[2], most[2])}});
  return layouts;
}

/// Expects that runs on 2, 3 and 4 ranks, with different layouts and numbers of threads from the `first` on, give the
/// result of one rank and one patch.
void expectSame(const std::string& scene, const std::vector<Index3>& layouts, const std::vector<std::string>& sets,
                std::size_t first = 0) {
  SCOPED_TRACE(scene);
  std::string expected;
  onRanks(1, [&](const mpi::Communicator& one) { expected = resultOf(scene, sets, Index3::filled(1), one, 1); });
  expected = test::allRanks().broadcast(expected);
  for (int count = 2; count <= test::allRanks().size(); ++count)
    onRanks(count, [&](const mpi::Communicator& ranks) {
      const std::size_t turn = first + count;
      const Index3& layout = layouts[turn % layouts.size()];
      const int threads = std::array{1, 2, 4}[turn % 3];
      EXPECT_EQ(resultOf(scene, sets, layout, ranks, threads), expected)
          << count << " ranks, " << threads << " threads, layout " << layout[0] << "x" << layout[1] << "x" << layout[2];
    });
}

/// Whether a task of a component solves a system over the whole grid.
bool solves(const Component& component) {
  tasks::TaskList tasks;
  component.scheduleInitialize(tasks);
  component.scheduleComputeStableTimeStep(tasks);
  component.scheduleTimeAdvance(tasks);
  return std::any_of(tasks.tasks().begin(), tasks.tasks().end(), [](const tasks::Task& task) { return task.perRank; });
}

/// Returns every explicit scene except those that are meant to fail.
std::vector<std::string> scenes() {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator("ups"))
    if (entry.path().extension() == ".ups" && entry.path().parent_path().filename() != "stability" &&
        !solves(*readScene(entry.path().string(), {}, catalogue()).component))
      found.push_back(entry.path().string());
  std::sort(found.begin(), found.end());
  return found;
}

const char* const steps[] = {"Time/max_Timesteps=6", "Time/max_Timesteps=5", "Time/max_Timesteps=2"};

}  // namespace

TEST(Ranks, GiveTheSameBitsOnEveryScene) {
  std::size_t turn = 0;
  for (const std::string& scene : scenes()) {
    const auto axes = static_cast<std::size_t>(dimensionOf(scene) - 1);
    expectSame(scene, layoutsOf(scene), {steps[axes]}, turn++);
  }
}

TEST(Ranks, GiveTheSameBitsWhereParticlesAreRedistributed) {
  const std::string mode = "MPM/gas_dynamics/redistribute/mode=reseed",
                    tracked = "MPM/gas_dynamics/volume_model=tracked";
  expectSame("ups/mpm/sod_redistribute.ups", {{{7, 1, 1}}, {{64, 1, 1}}}, {"Time/max_Timesteps=40"});
  expectSame("ups/mpm/sod_redistribute.ups", {{{64, 1, 1}}}, {"Time/max_Timesteps=40", mode, tracked});
}

}  // namespace tushar::simulation
