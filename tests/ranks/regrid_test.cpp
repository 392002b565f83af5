#include <gtest/gtest.h>

#include <set>

#include "core/tasks/regrid.hpp"
#include "tests/ranks/ranks.hpp"

// The shares of ranks after regridding.

namespace tushar::tasks {

namespace {

using namespace test;

constexpr ParticleLabel<Vec<1>> x{"p.x", "m", "position"};
constexpr int perCell = 8;

struct Material {
  std::string name;
};
const std::vector<Material> body{{"body"}};

/// A domain of 64 cells in blocks of 8, one patch per block, all refined once.
grid::Domain refinedLine() {
  grid::Domain domain;
  domain.upper = {1, 0, 0};
  domain.resolution = {{64, 1, 1}};
  domain.refinement.levels = 2;
  domain.refinement.blocksPerPatch = Index3{{1, 1, 1}};
  domain.refinement.regions.push_back({1, Vec3(0, 0, 0), Vec3(1, 0, 0)});
  return domain;
}

/// Creates eight particles in each of the 32 cells of the first quarter.
void create(const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<1>>& at) {
  forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    for (int k = 0; k < perCell && cell[0] < 32; ++k) {
      maker.add(cell, perCell * patch.level().cellNumber(cell) + k);
      at.push_back(patch.level().cellCentre<1>(cell));
    }
  });
}

/// Returns the number of particles on this rank, and checks that each is in its cell.
int particlesHere(Runner& run) {
  int count = 0;
  for (const Patch& patch : run.grid.patches()) {
    const data::ParticleSet& set = run.warehouse.particles(data::Generation::old, 0, patch.id());
    const int number = run.table.find("p.x", 0);
    const auto* at =
        reinterpret_cast<const Vec<1>*>(run.warehouse.variable(data::Generation::old, number, patch.id()).values);
    set.forEachOccupied<1>(patch.cells(), [&](const Index<1>& cell, const data::ParticleRange& particles) {
      for (const int p : particles) EXPECT_EQ(at[p], patch.level().cellCentre<1>(cell));
    });
    count += set.owned();
  }
  return count;
}

/// Returns the number of particles on this rank after the second half has been coarsened.
int particlesAfter(const mpi::Communicator& ranks, const PatchCosts& costs) {
  Runner run(refinedLine(), 1, ranks);
  TaskList list;
  list.newParticles("create", create, body, creates(x));
  TaskGraph graph = run.compile(list, {"p.x", std::string(data::particleId.name)});
  run.step(graph);
  const std::vector<grid::BlockId> kept{{0, {{0, 0, 0}}}, {0, {{1, 0, 0}}}, {0, {{2, 0, 0}}}, {0, {{3, 0, 0}}}};
  regrid(run.grid, run.grid.tree().regridded({}, kept), run.warehouse,
         {1, {run.table.find("p.x", 0), run.table.find(data::particleId.name, 0)}}, costs);
  EXPECT_EQ(run.grid.cellCount(), 64U + 32U);
  return particlesHere(run);
}

}  // namespace

TEST(Regridding, GivesRanksSharesThatCostTheSame) {
  onRanks(2, [](const mpi::Communicator& ranks) {
    // 4 of the 12 patches have 64 particles; with whole patches, the best division gives two of them to each rank.
    EXPECT_EQ(particlesAfter(ranks, {1, 1}), 2 * 64);
    // If cells are counted, the first half of them has all particles.
    EXPECT_EQ(particlesAfter(ranks, {1, 0}), ranks.isFirst() ? 4 * 64 : 0);
  });
}

TEST(Regridding, LeavesParticlesInTheirCellsOnAnyRanks) {
  for (const int count : {1, 3, 4})
    onRanks(count, [](const mpi::Communicator& ranks) {
      EXPECT_EQ(ranks.sum(static_cast<long>(particlesAfter(ranks, {}))), 4 * 64);
    });
}

}  // namespace tushar::tasks
