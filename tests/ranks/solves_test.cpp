#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/components.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/ranks/ranks.hpp"

// Scenes with a solve over the whole grid, on several ranks. For the cells of one level, the answer is bitwise the
// same. For nodes and several levels it is not, since the preconditioner and the order of sums depend on the number of
// ranks.

namespace tushar::simulation {

namespace {

using data::Generation;
using test::onRanks;

/// Returns a field on all ranks: for each cell its value or the sums over its particles, `width` values each.
std::vector<double> gathered(data::Warehouse& warehouse, const std::string& label, int width,
                             const mpi::Communicator& ranks) {
  const grid::Grid& grid = warehouse.grid();
  const auto wide = static_cast<std::size_t>(width);
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::vector<double> field(grid.finest().cells().size() * wide, none);
  const bool ofParticles = label.front() == 'p';
  const int number = warehouse.table().find(label, ofParticles ? 0 : -1);
  for (const grid::Patch& patch : grid.patches()) {
    const data::Variable held = warehouse.variable(Generation::old, number, patch.id());
    const auto* values = reinterpret_cast<const double*>(held.values);
    grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
      double* into = &field[patch.level().cellNumber<3>(cell) * wide];
      std::fill_n(into, width, 0.0);
      if (!ofParticles) into[0] = values[held.stored.offset(cell)];
      if (ofParticles)
        for (const int p : warehouse.particles(Generation::old, 0, patch.id()).at(cell))
          for (int k = 0; k < width; ++k) into[k] += values[p * width + k];
    });
  }
  ranks.max(field);
  std::replace(field.begin(), field.end(), none, 0.0);  // where there is no lower corner of a cell
  return field;
}

/// Returns the field at the end of a scene.
std::vector<double> result(const std::string& scene, const std::string& label, int width, std::vector<std::string> sets,
                           const mpi::Communicator& ranks) {
  sets.push_back("DataArchiver/outputInterval=0");
  Problem problem = scene::readScene(scene, sets, catalogue(), {}, test::shareOf(ranks));
  problem.archive.saves.clear();
  RunOptions options;
  options.quiet = true;
  Simulation simulation(std::move(problem), options, std::chrono::steady_clock::now(), ranks);
  EXPECT_EQ(simulation.run().failure, "");
  return gathered(simulation.warehouse(), label, width, ranks);
}

/// Expects that runs on 2 and 4 ranks agree with one rank to `tolerance` of the largest value.
void expectSame(const std::string& scene, const std::string& label, int width, const std::vector<std::string>& sets,
                double tolerance = 1e-10) {
  SCOPED_TRACE(scene);
  const std::vector<double> expected = result(scene, label, width, sets, mpi::Communicator::alone());
  double greatest = 0;
  for (const double value : expected) greatest = std::max(greatest, std::abs(value));
  ASSERT_GT(greatest, 0);
  for (const int count : {2, 4})
    onRanks(count, [&](const mpi::Communicator& ranks) {
      const std::vector<double> found = result(scene, label, width, sets, ranks);
      double worst = 0;
      for (std::size_t k = 0; k < expected.size(); ++k) worst = std::max(worst, std::abs(found[k] - expected[k]));
      EXPECT_LE(worst / greatest, tolerance) << count << " ranks";
    });
}

void expectSameBits(const std::string& scene, const std::string& label, const std::vector<std::string>& sets) {
  expectSame(scene, label, 1, sets, 0);
}

const char* const patches = "Grid/Level/Box/patches=[4,2,1]";

}  // namespace

TEST(Solves, GiveTheSameFieldOfPoissonsEquationOnAnyRanks) {
  expectSameBits("ups/poisson/sine.ups", "c.phi", {patches, "Time/max_Timesteps=2"});
}

// 64 planes in slabs of 32 and 16, with 131072 cells. Ranks share the next level, too, and each computes the one after
// it by itself.
TEST(Solves, GiveTheSameFieldInThreeDimensionsOnAnyRanks) {
  expectSameBits("ups/poisson/sine.ups", "c.phi",
                 {"Grid/Level/Box/patches=[2,2,2]", "Grid/Level/Box/resolution=[64,32,64]", "Time/max_Timesteps=1"});
}

TEST(Solves, GiveTheSameTemperatureOnAnyRanks) {
  expectSameBits("ups/heat/implicit.ups", "c.temperature",
                 {"Grid/Level/Box/patches=[5,1,1]", "Heat/thermal_conductivity=1 + x"});
}

TEST(Solves, GiveTheSameSlowGasOnAnyRanks) {
  expectSameBits("ups/ice/hot_bubble.ups", "c.density",
                 {patches, "Grid/Level/Box/resolution=[16,32,1]", "Time/max_Timesteps=10"});
}

// The systems are solved to 1e-13, so that what is left is the conditioning, below 1e3 here, times rounding.
TEST(Solves, GiveTheSameFieldsOverSeveralLevelsOnAnyRanks) {
  expectSame("ups/poisson/levels.ups", "c.phi", 1, {"Poisson/Solver/tolerance=1e-13", "Time/max_Timesteps=1"});
  expectSame("ups/heat/implicit_levels.ups", "c.temperature", 1,
             {"Heat/Solver/tolerance=1e-13", "Heat/thermal_conductivity=1 + x/2", "Time/max_Timesteps=2"});
}

TEST(Solves, GiveTheSamePlacesOfASolidOnAnyRanks) {
  expectSame("ups/solid/implicit_cantilever.ups", "p.x", 2, {patches});
}

TEST(Solves, GiveTheSamePlacesWithGimpAndInertia) {
  expectSame("ups/solid/implicit_cantilever.ups", "p.x", 2,
             {patches, "MPM/interpolator=gimp", "MPM/dynamic=true", "MPM/DoPressureStabilization=true"});
}

TEST(Solves, RunWhereARankHasNoPatch) {
  expectSameBits("ups/poisson/sine.ups", "c.phi", {"Grid/Level/Box/patches=[2,1,1]", "Time/max_Timesteps=1"});
}

}  // namespace tushar::simulation
