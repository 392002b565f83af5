#include "components/mpm/gas/conserving/batch.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "tests/mpm/gas/conserving/boxes.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

/// Zero to three particles in each cell of a plane whose rows do not fill the last SIMD lanes.
struct Uneven : test::Particles {
  std::vector<Vec<2>> v;

  Uneven() : Particles(freeDomain({{11, 3, 1}})) {
    set.reset(patch(), 0);
    forEach<2>(level.cells(), [&](const Index<2>& cell) {
      const int first = static_cast<int>(v.size()), count = (3 * cell[0] + cell[1]) % 4;
      for (int k = 0; k < count; ++k) v.push_back({first + k, 0.5 * cell[0]});
      set.at(cell) = {first, first + count};
    });
    set.setOwned(static_cast<int>(v.size()));
  }
};

}  // namespace

TEST(Batch, HoldsEachParticleOnceInTheLaneOfItsCell) {
  Uneven cloud;
  std::vector<int> visits(cloud.v.size());
  const auto view = cloud.read(cloud.v);
  forEachBatch<2>(cloud.level.cells(), view, [&](const Batch<2>& batch) {
    EXPECT_EQ(batch.isFull, all(batch.used));
    for (int lane = 0; lane < Lanes::count; ++lane) {
      const Index<2> cell{{batch.cell[0][lane], batch.cell[1][lane]}};
      const data::ParticleRange there = view.in(cell);
      EXPECT_TRUE(there.first <= batch.place[lane] && batch.place[lane] < there.last);
      if (batch.used[lane] == 0) continue;
      EXPECT_EQ(cell[0], batch.start[0] + lane);
      ++visits[static_cast<std::size_t>(batch.place[lane])];
    }
  });
  EXPECT_EQ(visits, std::vector<int>(cloud.v.size(), 1));
}

TEST(Batch, StoresOnlyLanesInUse) {
  Uneven cloud;
  std::vector<Vec<2>> copy(cloud.v.size(), Vec<2>(-1, -1));
  const auto view = cloud.read(cloud.v);
  forEachBatch<2>(cloud.level.cells(), view, [&](const Batch<2>& batch) {
    LanesVec<2> values = load(view, batch);
    for (int d = 0; d < 2; ++d) values[d] = select(batch.used, values[d], 99);
    store(values, cloud.write(copy), batch);
  });
  EXPECT_EQ(copy, cloud.v);
}

TEST(Batch, ClearsAndIgnoresLanesNotInUse) {
  const Batch<2> one = batchOfOne<2>({{3, 1}});
  const Lanes ones = one.only(1);
  EXPECT_EQ(ones[0], 1);
  for (int lane = 1; lane < Lanes::count; ++lane) EXPECT_EQ(ones[lane], 0);
  EXPECT_TRUE(one.holds(ones > 0));
  EXPECT_FALSE(one.holds(ones < 1));
}

TEST(AlignedNumbers, BeginACacheLine) {
  for (const std::size_t count : {1, 7, 64, 1001}) {
    const AlignedNumbers numbers(count);
    numbers[count - 1] = 1;
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(&numbers[0]) % alignof(Lanes), 0u);
  }
}

TEST(AlignedNumbers, BeginACacheLineAndUseMemoryOfEarlierOnesOfThisThread) {
  const double* before = nullptr;
  {
    const AlignedNumbers first(1000);
    before = first.get();
    const AlignedNumbers other(1000);
    EXPECT_NE(other.get(), before);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(before) % alignof(Lanes), 0u);
  }
  AlignedNumbers again(900), moved = std::move(again);
  const AlignedNumbers small(10);
  EXPECT_NE(small.get(), before) << "much smaller ones do not take it";
  const AlignedNumbers next(1000);
  EXPECT_TRUE(moved.get() == before || next.get() == before);
}

}  // namespace tushar::mpm::gas::conserving
