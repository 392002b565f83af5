#include "tests/mpm/solid/implicit/block.hpp"

namespace tushar::mpm::solid::implicit {

using namespace testing;

TEST(ImplicitHeat, SpreadsEvenlyInOneLongStepAndKeepsTheHeat) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{6, 2, 1}});
  for (std::size_t p = 0; p < block.x().size(); ++p) block.temperature()[p] = block.x()[p][0] < 3 ? 400 : 300;

  // The slowest part decays at k pi²/(rho c L²) = 2.7e-4 /s: 50 K / 2.7e6 of it remain.
  for (const Vec<2>& x : block.x()) EXPECT_NEAR(block.temperatureAfter(1e10, x), 350, 1e-4);
  // In a shorter step, heat flows from the warm half to the cold one, and none is lost.
  double sum = 0;
  for (const Vec<2>& x : block.x()) sum += block.temperatureAfter(1000, x);
  EXPECT_NEAR(sum / double(block.x().size()), 350, 1e-7);
  EXPECT_GT(block.temperatureAfter(1000, Vec<2>(3.75, 0.25)), block.temperatureAfter(10, Vec<2>(3.75, 0.25)) + 1);
}

TEST(ImplicitHeat, SpreadsSlowerWhereTheGridHasBeenStretched) {
  // Twice as long, a bar has half the slopes and twice the volume: it takes twice the time.
  Block<LinearShape<1>> bar(modelOf(rubber()), {{6, 1, 1}}), stretched(modelOf(rubber()), {{6, 1, 1}}, 2);
  stretched.resetsGrid = false;
  for (auto* block : {&bar, &stretched})
    for (std::size_t p = 0; p < block->x().size(); ++p) block->temperature()[p] = block->x()[p][0] < 3 ? 400 : 300;

  for (const Vec<1>& x : bar.x()) EXPECT_NEAR(stretched.temperatureAfter(2000, x), bar.temperatureAfter(1000, x), 1e-9);
  EXPECT_GT(bar.temperatureAfter(1000, Vec<1>(3.75)), 301);
}

TEST(ImplicitHeat, TakesTheHeatOfLoads) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{6, 2, 1}});
  for (double& temperature : block.temperature()) temperature = 300;
  const double mass = block.mass().front(), dt = 7;  // and c = 1
  block.heatFlux.assign(block.x().size(), 2 * mass);
  for (const Vec<2>& x : block.x()) EXPECT_NEAR(block.temperatureAfter(dt, x), 300 + 2 * dt, 1e-9);
  // One particle has it all: the sum stays.
  block.heatFlux.assign(block.x().size(), 0);
  block.heatFlux[5] = 2 * mass;
  double sum = 0;
  for (const Vec<2>& x : block.x()) sum += block.temperatureAfter(dt, x) - 300;
  EXPECT_NEAR(sum, 2 * dt, 1e-8);
}

}  // namespace tushar::mpm::solid::implicit
