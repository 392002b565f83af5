#include "core/collect/particle_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/core.hpp"
#include "tests/support/run.hpp"

namespace tushar::collect {

namespace {

struct Dust {
  std::string name;
};
const std::vector<Dust> dusts{{"fine"}};
const ParticleLabel<Vec<2>> position{"p.x", "m", "position"};

/// 32 x 32 cells, of which some are divided into 4 x 4.
grid::Domain refined(int blocksPerPatch) {
  grid::Domain domain;
  domain.upper = {1, 1, 0};
  domain.resolution = {{32, 32, 1}};
  domain.refinement.levels = 3;
  domain.refinement.blocksPerPatch = Index3::filled(blocksPerPatch);
  domain.refinement.regions.push_back({2, Vec3(0.3, 0.3, 0), Vec3(0.5, 0.7, 0)});
  return domain;
}

/// Particles of ids that fall up the grid, none to two in each of the finest cells.
void scatter(const Patch& patch, const Dust&, ParticleMaker& maker, std::vector<Vec<2>>& x) {
  if (patch.level().number() < 2) return;
  forEach<2>(patch.cells(), [&](const Index<2>& cell) {
    for (int k = 0; k < (cell[0] + 2 * cell[1]) % 3; ++k) {
      maker.add(cell, 1000000 - 2 * patch.level().cellNumber<2>(cell) - static_cast<ParticleId>(k));
      x.push_back(patch.level().cellCentre<2>(cell));
    }
  });
}

class Scattered : public test::Runner {
 public:
  explicit Scattered(int blocksPerPatch) : Runner(refined(blocksPerPatch)) {
    TaskList list;
    list.newParticles("scatter", scatter, dusts, creates(position));
    tasks::TaskGraph graph = compile(list, {"p.x", "p.particleID"});
    step(graph);
  }

  std::vector<ParticleId> idsInOrder() {
    const ParticleOrder order(warehouse, 0);
    std::vector<ParticleId> ids(order.count());
    for (const Patch& patch : grid.patches()) {
      const data::Variable held = warehouse.variable(data::Generation::old, table.find("p.particleID", 0), patch.id());
      order.forEachRun(patch, [&](std::size_t place, std::size_t from, std::size_t count) {
        std::copy_n(reinterpret_cast<const ParticleId*>(held.values) + from, count, &ids[place]);
      });
    }
    return ids;
  }
};

}  // namespace

TEST(ParticleOrder, OfSeveralLevelsIsThatOfTheCellsThatThereAreOnAnyPatches) {
  Scattered small(1), large(4);
  const ParticleOrder order(small.warehouse, 0);

  EXPECT_EQ(order.perCell().size(), small.grid.cellCount());
  EXPECT_LT(small.grid.cellCount(), small.grid.finest().cells().size() / 2);
  EXPECT_EQ(order.perCell(), ParticleOrder(large.warehouse, 0).perCell());
  const std::vector<ParticleId> ids = small.idsInOrder();
  EXPECT_GT(ids.size(), 1000u);
  EXPECT_EQ(std::count(ids.begin(), ids.end(), ParticleId{0}), 0);
  EXPECT_EQ(ids, large.idsInOrder());
}

TEST(ParticleOrder, IsInstalledOnOtherPatches) {
  Scattered small(1), large(4);
  const std::vector<std::int32_t> perCell = ParticleOrder(small.warehouse, 0).perCell();

  ParticleOrder(large.warehouse, 0, perCell).install();

  EXPECT_EQ(ParticleOrder(large.warehouse, 0).perCell(), perCell);
}

}  // namespace tushar::collect
