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

/// A domain of 32 x 32 cells, some of which are divided into 4 x 4.
grid::Domain refined(int blocksPerPatch) {
  grid::Domain domain;
  domain.upper = {1, 1, 0};
  domain.resolution = {{32, 32, 1}};
  domain.refinement.levels = 3;
  domain.refinement.blocksPerPatch = Index3::filled(blocksPerPatch);
  domain.refinement.regions.push_back({2, Vec3(0.3, 0.3, 0), Vec3(0.5, 0.7, 0)});
  return domain;
}

/// Creates zero to two particles in each of the finest cells, with ids that decrease along the grid.
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
    for (const Run& run : order.runs()) {
      const int patch = grid.patches()[run.patch].id();
      const data::Variable held = warehouse.variable(data::Generation::old, table.find("p.particleID", 0), patch);
      std::copy_n(reinterpret_cast<const ParticleId*>(held.values) + run.first, run.count, &ids[run.place]);
    }
    return ids;
  }

  /// Returns the number of particles of each cell.
  std::vector<std::int32_t> perCell() {
    const ParticleOrder order(warehouse, 0);
    const auto source = order.perCell();
    std::vector<std::int32_t> counts(source->entries());
    source->read(0, counts.size(), reinterpret_cast<std::byte*>(counts.data()));
    return counts;
  }
};

}  // namespace

TEST(ParticleOrder, OfSeveralLevelsIsThatOfTheCellsThatThereAreOnAnyPatches) {
  Scattered small(1), large(4);

  EXPECT_EQ(small.perCell().size(), small.grid.cellCount());
  EXPECT_LT(small.grid.cellCount(), small.grid.finest().cells().size() / 2);
  EXPECT_EQ(small.perCell(), large.perCell());
  const std::vector<ParticleId> ids = small.idsInOrder();
  EXPECT_GT(ids.size(), 1000u);
  EXPECT_EQ(std::count(ids.begin(), ids.end(), ParticleId{0}), 0);
  EXPECT_EQ(ids, large.idsInOrder());
}

TEST(ParticleOrder, IsInstalledOnOtherPatches) {
  Scattered small(1), large(4);
  const std::vector<std::int32_t> perCell = small.perCell();

  ParticleOrder(large.warehouse, 0, [&](const std::vector<ParticleOrder::Wanted>& wanted) {
    for (const auto& [first, count, to] : wanted) std::copy_n(&perCell[first], count, to);
  }).install();

  EXPECT_EQ(large.perCell(), perCell);
}

}  // namespace tushar::collect
