#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "core/data/buffer.hpp"
#include "core/data/buffer_pool.hpp"
#include "core/data/reduction.hpp"
#include "core/data/views.hpp"
#include "core/data/wide_sum.hpp"
#include "core/grid/grid.hpp"

namespace tushar::data {

TEST(Label, StoresAsManyNumbersAsThereAreAxes) {
  EXPECT_EQ((ParticleLabel<Vec<1>>("p.v", "m/s", "")).bytes, 8u);
  EXPECT_EQ((ParticleLabel<Vec<3>>("p.v", "m/s", "")).bytes, 24u);
}

TEST(Label, StartsWithThePrefixOfItsCentring) {
  EXPECT_THROW(ParticleLabel<double>("g.mass", "kg", ""), std::invalid_argument);
  EXPECT_THROW(CellLabel<double>("mass", "kg", ""), std::invalid_argument);
}

TEST(Label, CountsNearParticlesOnlyOnNodes) {
  EXPECT_EQ(NodeLabel<double>("g.mass", "kg", "", Counts::nearParticles).counts, Counts::nearParticles);
  EXPECT_EQ(NodeLabel<double>("g.mass", "kg", "").counts, Counts::everywhere);
  EXPECT_THROW(CellLabel<double>("c.mass", "kg", "", Counts::nearParticles), std::invalid_argument);
}

TEST(Sum, DoesNotDependOnTheOrder) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> exponent(-20, 20);
  std::vector<double> values;
  for (int k = 0; k < 1000; ++k) values.push_back((k % 2 ? 1 : -1) * std::exp(exponent(generator)));
  const auto sumOf = [&] {
    Sum sum;
    for (const double value : values) sum.add(value);
    return sum.total();
  };

  const double first = sumOf();

  for (int k = 0; k < 20; ++k) {
    std::shuffle(values.begin(), values.end(), generator);
    EXPECT_EQ(sumOf(), first);
  }
}

TEST(Sum, DoesNotDependOnTheOrderIfTheTermsCancelButForAMillionthOfTheirRoundOff) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> size(0, 1);
  std::vector<double> values;
  for (int k = 0; k < 500; ++k) {
    const double value = size(generator);
    values.insert(values.end(), {value, -value * (1 + size(generator) * 1e-15), size(generator) * 1e-22});
  }
  Sum all;
  for (const double value : values) all.add(value);
  values.push_back(-all.total());

  std::set<double> totals;
  for (int k = 0; k < 50; ++k) {
    std::shuffle(values.begin(), values.end(), generator);
    Sum sum;
    for (const double value : values) sum.add(value);
    totals.insert(sum.total());
  }
  EXPECT_EQ(totals.size(), 1);
}

TEST(Sum, IsTheSameInLanes) {
  Sum plain, wide;
  {
    WideSum lanes(wide);
    for (int k = 1; k < 1000; ++k) {
      plain.add(1.0 / k);
      lanes.add(1.0 / k);
    }
  }

  EXPECT_EQ(plain.total(), wide.total());
}

TEST(Sum, TakesManyNumbersAtOnce) {
  for (const int count : {0, 1, 7, 127, 128, 129, 1000}) {
    Sum plain, wide;
    {
      WideSum lanes(wide);
      plain.add(1e20);
      lanes.add(1e20);
      lanes.addAll(count, [](int k) { return 1.0 / (k + 1); });
      for (int k = 0; k < count; ++k) plain.add(1.0 / (k + 1));
      lanes.add(-1e20);
      plain.add(-1e20);
    }

    EXPECT_EQ(plain.total(), wide.total()) << count;
  }
}

TEST(Norm, HasMeanRootMeanSquareAndMaximum) {
  Norm norm, rest;
  norm.add(3, 10);
  rest.add(-4, -4);
  norm.merge(rest);

  EXPECT_EQ(norm.values(), (std::vector<double>{3.5, std::sqrt(12.5), 4, 0.5}));
}

TEST(Norm, DoesNotHideANaN) {
  Norm norm;
  norm.add(std::nan(""));
  norm.add(1);

  EXPECT_TRUE(std::isnan(norm.max));
}

TEST(GridView, IsFilledWithEqualAndWithDifferentNumbers) {
  const grid::Box box{{0, 0, 0}, {3, 2, 1}};
  std::vector<Vec<2>> values(6, Vec<2>(7, 8));
  const CellView<Vec<2>> view(values.data(), box);
  for (const Vec<2>& value : {Vec<2>(1, 1), Vec<2>(1, 2), Vec<2>(-0.0, 0.0), Vec<2>(0, 0)}) {
    view.fill(value);
    for (const Vec<2>& one : values)
      for (int d = 0; d < 2; ++d) {
        EXPECT_EQ(one[d], value[d]);
        EXPECT_EQ(std::signbit(one[d]), std::signbit(value[d]));
      }
  }
}

TEST(Buffer, KeepsWhatItIsToldToKeepWhenItGrows) {
  Buffer buffer;
  buffer.reserve(8);
  buffer.data()[7] = std::byte{42};

  buffer.reserve(1 << 20, 8);

  EXPECT_EQ(buffer.data()[7], std::byte{42});
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer.data()) % 64, 0u);
}

TEST(BufferPool, GivesEachSizeItsOwnAgain) {
  constexpr std::size_t large = 8'000'000, small = 1'000'000;
  BufferPool pool;
  Buffer first, second;
  pool.reserve(first, large);
  pool.reserve(second, small);
  for (int step = 0; step < 3; ++step) {
    pool.takeBack(first);
    pool.takeBack(second);
    pool.reserve(second, small);
    pool.reserve(first, large);
  }
  EXPECT_EQ(pool.allocations(), 2u);
  EXPECT_LT(second.capacity(), 2 * small);
}

TEST(BufferPool, GivesUpWhatWasOutgrownALittle) {
  BufferPool pool;
  Buffer buffer;
  pool.reserve(buffer, 1'000'000);
  const std::size_t before = buffer.capacity();
  pool.takeBack(buffer);
  pool.reserve(buffer, before + 1);
  Buffer other;
  pool.reserve(other, before);
  EXPECT_EQ(pool.allocations(), 3u) << "the first buffer is gone, so the third request makes another";
}

TEST(BufferPool, LendsTheSmallestThatIsLargeEnough) {
  BufferPool pool;
  Buffer large, middle;
  pool.reserve(large, 8'000'000);
  pool.reserve(middle, 2'000'000);
  const std::byte* const expected = middle.data();
  pool.takeBack(large);
  pool.takeBack(middle);

  EXPECT_EQ(pool.lend(1000).data(), expected);
  EXPECT_EQ(pool.allocations(), 2u);
  pool.release();
  EXPECT_GE(pool.lend(1000).capacity(), 1000u);
  EXPECT_EQ(pool.allocations(), 3u);
}

TEST(BufferPool, TakesAFreeBufferForOneThatGrows) {
  BufferPool pool;
  Buffer other, large, small;
  pool.reserve(other, 2'000'000);
  pool.reserve(large, 2'000'000);
  pool.takeBack(large);
  pool.reserve(small, 800'000);
  small.data()[799'999] = std::byte{42};

  pool.reserve(small, 1'900'000, 800'000);

  EXPECT_EQ(pool.allocations(), 3u);
  EXPECT_EQ(small.data()[799'999], std::byte{42});
}

TEST(BufferPool, HoldsNoMoreThanItsBoundHoweverSizesChange) {
  constexpr std::size_t variables = 8, largest = 1'300'000;
  std::mt19937 generator(1);
  BufferPool pool;
  for (int step = 0; step < 200; ++step) {
    pool.beginStep();
    std::vector<Buffer> held(variables);
    for (Buffer& variable : held) {
      const std::size_t bytes = 100'000 + generator() % 900'000;
      pool.reserve(variable, bytes);
      pool.reserve(variable, bytes + generator() % 300'000, bytes);
      ASSERT_LE(pool.free() + pool.lent(), pool.bound());
    }
    for (Buffer& variable : held) pool.takeBack(variable);
    ASSERT_LE(pool.free() + pool.lent(), pool.bound());
    ASSERT_LE(pool.bound(), (variables + 1) * largest * 3 / 2);
  }
  EXPECT_EQ(pool.lent(), 0u);
}

TEST(BufferPool, KeepsWhatEverySecondStepNeeds) {
  BufferPool pool;
  Buffer always, sometimes;
  pool.reserve(always, 8'000'000);
  for (int step = 0; step < 10; ++step) {
    pool.beginStep();
    if (step % 2 != 0) continue;
    pool.reserve(sometimes, 1'000'000);
    pool.takeBack(sometimes);
  }
  EXPECT_EQ(pool.allocations(), 2u);
}

TEST(BufferPool, GivesUpWhatAFewStepsDidNotNeed) {
  BufferPool pool;
  Buffer buffer;
  pool.reserve(buffer, 1'000'000);
  pool.takeBack(buffer);
  pool.beginStep();
  EXPECT_GT(pool.free(), 0u) << "the step may still ask for it";
  for (int step = 0; step < 3; ++step) pool.beginStep();
  EXPECT_EQ(pool.free(), 0u);
}

/// A particle set on a grid of 5 x 4 x 3 cells, some of them without particles.
ParticleSet someCells(const grid::Grid& grid, int reach = 0) {
  ParticleSet set;
  set.reset(grid.patches().front(), reach);
  int count = 0;
  grid::forEach<3>(grid.level().cells(), [&](const Index3& cell) {
    const int first = count;
    if (cell[1] != 2 && (cell[0] + cell[2]) % 3 == 1) count += 2;
    set.at(cell) = {first, count};
  });
  set.setOwned(count);
  return set;
}

TEST(ParticleSet, VisitsTheCellsOfABoxThatHoldParticlesInOrder) {
  grid::Domain domain;
  domain.resolution = {{5, 4, 3}};
  domain.upper = {5, 4, 3};
  const grid::Grid grid(domain);
  const grid::Level& level = grid.level();
  const ParticleSet set = someCells(grid);
  for (const grid::Box& box :
       {level.cells(), grid::Box{{{1, 0, 1}}, {{4, 3, 3}}}, grid::Box{{{2, 1, 0}}, {{2, 3, 2}}}}) {
    std::vector<std::pair<Index3, int>> expected, visited;
    grid::forEach<3>(box, [&](const Index3& cell) {
      if (!set.in(cell).empty()) expected.emplace_back(cell, set.in(cell).first);
    });
    set.forEachOccupied<3>(
        box, [&](const Index3& cell, const ParticleRange& range) { visited.emplace_back(cell, range.first); });
    EXPECT_EQ(visited, expected);
  }
}

TEST(ParticleSet, IsEmptyAfterAReset) {
  grid::Domain domain;
  domain.resolution = {{5, 4, 3}};
  domain.upper = {5, 4, 3};
  const grid::Grid grid(domain);
  const grid::Level& level = grid.level();
  ParticleSet set = someCells(grid);

  set.reset(grid.patches().front(), 0);

  grid::forEach<3>(level.cells(), [&](const Index3& cell) { EXPECT_TRUE(set.in(cell).empty()); });
  set.forEachOccupied<3>(level.cells(), [](const Index3&, const ParticleRange&) { ADD_FAILURE(); });
  EXPECT_TRUE(set.hasNone());
}

/// A patch that is its own periodic image reads and writes the same table: see Exchange::placeGhostCopies.
TEST(ParticleSet, KeepsItsRangesWherePlacesForItsOwnPeriodicImagesAreOpen) {
  grid::Domain domain;
  domain.resolution = {{5, 4, 3}};
  domain.upper = {5, 4, 3};
  domain.periodic = {{1, 1, 1}};
  const grid::Grid grid(domain);
  const grid::Level& level = grid.level();
  ParticleSet set = someCells(grid, 1);
  const int owned = set.owned();
  for (const Index3& shift : {Index3{{0, -4, 0}}, Index3{{-5, 0, 3}}}) {
    grid::Box images = level.cells().shifted(shift);
    for (int d = 0; d < 3; ++d) {
      images.lower[d] = std::max(images.lower[d], -1);
      images.upper[d] = std::min(images.upper[d], level.cells().upper[d] + 1);
    }
    set.openGhostRows(images, set, shift);
    const ParticleRange* const before = set.row(Index3{});
    int to = owned, added = 0;
    grid::forEach<3>(images, [&](const Index3& cell) {
      const ParticleRange& there = set.in(cell - shift);
      set.addCopies(cell, 0, there, shift, to);
      EXPECT_EQ(set.in(cell).size(), set.in(cell - shift).size());
      to += set.in(cell).size();
      added += set.in(cell).size();
    });
    EXPECT_GT(added, 0);
    EXPECT_EQ(set.row(Index3{}), before) << "ranges moved while the set was read";
  }
}

TEST(View, RefusesWhatIsOutsideNamingTheLabel) {
  if (!checked) GTEST_SKIP() << "views are checked in the dev preset only";
  constexpr CellLabel<double> label{"c.height", "m", "height"};
  std::vector<double> values(4);
  const grid::Box box{{}, {{4, 1, 1}}};
  const CellView<double> view(values.data(), box, box, &label);

  try {
    view[Index<1>{{4}}] = 1;
    FAIL();
  } catch (const AccessError& error) {
    EXPECT_STREQ(error.what(),
                 "c.height was accessed at (4,0,0), outside the box (0,0,0) to (3,0,0) that the task declared; declare "
                 "more ghosts, or stay inside the box");
  }
}

}  // namespace tushar::data
