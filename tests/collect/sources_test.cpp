#include "core/collect/sources.hpp"

#include <gtest/gtest.h>

#include "core/core.hpp"
#include "tests/support/levels.hpp"

namespace tushar::collect {

namespace {

Part partOf(const std::vector<std::uint64_t>& ids) {
  return {reinterpret_cast<const std::byte*>(ids.data()), ids.size()};
}

Part partOf(const std::vector<double>& values) {
  return {reinterpret_cast<const std::byte*>(values.data()), values.size()};
}

/// Reads a source in pieces of the given number of entries and returns all values.
std::vector<double> readBy(const output::Source& source, std::size_t piece, std::size_t numbers) {
  std::vector<double> values(source.entries() * numbers);
  for (std::size_t first = 0; first < source.entries(); first += piece)
    source.read(first, std::min(piece, source.entries() - first),
                reinterpret_cast<std::byte*>(values.data() + first * numbers));
  return values;
}

const data::ParticleLabel<double> mass{"p.mass", "kg", "mass"};
const data::ParticleLabel<Vec<2>> position{"p.x", "m", "position"};
const data::ParticleLabel<Vec<2>> velocity{"p.velocity", "m/s", "velocity"};
const data::CellLabel<double> heat{"c.heat", "K", "temperature"};
const data::NodeLabel<double> speed{"g.speed", "m/s", "speed"};

}  // namespace

TEST(PlacesById, AreInAscendingOrderWhateverBitsTheIdsDifferIn) {
  const std::vector<std::uint64_t> first{std::uint64_t{5} << 60, 3, std::uint64_t{1} << 40},
      second{(std::uint64_t{1} << 40) + 2048, 0, std::uint64_t{1} << 63};
  const Parts ids{{partOf(first), Part{}, partOf(second)}};

  const std::vector<Place> places = placesById(ids);

  std::vector<std::uint64_t> ordered;
  for (const Place& place : places) ordered.push_back((place.patch == 0 ? first : second)[place.index]);
  EXPECT_EQ(ordered, (std::vector<std::uint64_t>{0, 3, std::uint64_t{1} << 40, (std::uint64_t{1} << 40) + 2048,
                                                 std::uint64_t{5} << 60, std::uint64_t{1} << 63}));
}

TEST(PlacesById, AreInAscendingOrderWhereTheIdsAreDense) {
  const std::vector<std::uint64_t> first{(7 << 16) + 1, 6 << 16, 5 << 16}, second{7 << 16, (5 << 16) + 1};

  const std::vector<Place> places = placesById(Parts{{partOf(first), partOf(second)}});

  std::vector<std::uint64_t> ordered;
  for (const Place& place : places) ordered.push_back((place.patch == 0 ? first : second)[place.index]);
  EXPECT_EQ(ordered, (std::vector<std::uint64_t>{5 << 16, (5 << 16) + 1, 6 << 16, 7 << 16, (7 << 16) + 1}));
}

TEST(PlacesById, AreOneForOneParticle) {
  const std::vector<std::uint64_t> id{42};

  EXPECT_EQ(placesById(Parts{{Part{}, partOf(id)}}).size(), 1U);
}

TEST(RankedById, RefusesIdsThatRepeat) {
  const std::vector<std::uint64_t> dense{3, 4, 5}, one{4}, sparse{3, std::uint64_t{1} << 50, std::uint64_t{1} << 40},
      other{std::uint64_t{1} << 40};
  EXPECT_THROW(rankedById(mpi::Communicator::alone(), Parts{{partOf(dense), partOf(one)}}), TaskError);
  EXPECT_THROW(rankedById(mpi::Communicator::alone(), Parts{{partOf(sparse), partOf(other)}}), TaskError);
  EXPECT_EQ(rankedById(mpi::Communicator::alone(), Parts{{partOf(dense), partOf(other)}}).count, 4U);
}

TEST(PlacesById, AreNoneWithoutParticles) { EXPECT_TRUE(placesById(Parts{{Part{}, Part{}}}).empty()); }

TEST(SourceInRuns, GivesTheSameForPiecesThatCutRuns) {
  const std::vector<double> left{1, 2, 5, 6, 9, 10}, right{3, 4, 7, 8, 11, 12};
  const auto runs = std::make_shared<const Runs>(
      Runs{{0, 0, 0, 2}, {2, 1, 0, 2}, {4, 0, 2, 2}, {6, 1, 2, 2}, {8, 0, 4, 2}, {10, 1, 4, 2}});
  const auto source = sourceInRuns(runs, 12, Parts{{partOf(left), partOf(right)}}, EntryForm(mass));

  for (const std::size_t piece : {1, 3, 5, 12})
    EXPECT_EQ(readBy(*source, piece, 1), (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})) << piece;
}

TEST(SourceInRuns, SaysWhatOfAPieceThisRankHas) {
  const std::vector<double> own{1, 2, 5, 6, 9, 10};
  const auto runs = std::make_shared<const Runs>(Runs{{0, 0, 0, 2}, {4, 0, 2, 2}, {6, 0, 4, 1}, {8, 0, 5, 1}});
  const auto source = sourceInRuns(runs, 12, Parts{{partOf(own)}}, EntryForm(mass));
  std::vector<double> packed(4), placed(8, -1);

  const std::vector<output::Stretch> stretches = source->stretches(1, 7);
  source->pack(1, 7, reinterpret_cast<std::byte*>(packed.data()));
  source->read(1, 7, reinterpret_cast<std::byte*>(placed.data()));

  ASSERT_EQ(stretches.size(), 2u);
  EXPECT_EQ(
      (std::vector<std::uint32_t>{stretches[0].first, stretches[0].count, stretches[1].first, stretches[1].count}),
      (std::vector<std::uint32_t>{0, 1, 3, 3}));
  EXPECT_EQ(packed, (std::vector<double>{2, 5, 6, 9}));
  EXPECT_EQ(placed, (std::vector<double>{2, -1, -1, 5, 6, 9, -1, -1}));
}

TEST(RunsOfGrid, GiveNodesOnFacesBetweenPatchesOnce) {
  const grid::Grid grid(test::domain({{5, 4, 1}}, {{2, 2, 1}}));
  std::vector<Part> parts;
  for (const grid::Patch& patch : grid.patches()) parts.push_back({nullptr, 0, patch.nodes()});

  const Runs runs = runsOfGrid(grid, speed, Parts{parts}, GridOrder(grid.level().nodesOfCells()));

  std::size_t next = 0;
  for (const auto& run : runs) {
    EXPECT_EQ(run.place, next);
    next += run.count;
  }
  EXPECT_EQ(next, 30u);
}

TEST(RunsOfGrid, AreRowsOfPatchesWithoutTheirGhosts) {
  const grid::Grid grid(test::domain({{4, 2, 1}}, {{2, 1, 1}}));
  std::vector<Part> parts;
  for (const grid::Patch& patch : grid.patches()) parts.push_back({nullptr, 0, patch.cellsWithin(1)});

  const Runs runs = runsOfGrid(grid, heat, Parts{parts}, GridOrder(grid.level().cells()));

  std::vector<std::size_t> places, firsts;
  for (const auto& run : runs) {
    places.push_back(run.place);
    firsts.push_back(run.first);
  }
  EXPECT_EQ(places, (std::vector<std::size_t>{0, 2, 4, 6}));
  EXPECT_EQ(firsts, (std::vector<std::size_t>{0, 1, 3, 4}));  // 3 cells in memory to a row, ghosts included
}

TEST(EntryForm, WidensPositionsToTheMiddleOfTheAxisLeftOut) {
  const grid::Grid grid(test::domain({{4, 2, 1}}));
  const grid::Level& level = grid.level();
  const std::vector<double> entries{0.1, 0.2, 0.3, 0.4};
  const Parts parts{{partOf(entries)}};
  const auto places = std::make_shared<const ParticlePlaces>(ParticlePlaces{{{0, 1}, {0, 0}}, {}, 2});

  const auto x = sourceAt(places, parts, EntryForm(position, level));
  const auto v = sourceAt(places, parts, EntryForm(velocity, level));

  EXPECT_EQ(readBy(*x, 2, 3), (std::vector<double>{0.3, 0.4, 0.2, 0.1, 0.2, 0.2}));  // z from 0 to 0.4 m
  EXPECT_EQ(readBy(*v, 1, 3), (std::vector<double>{0.3, 0.4, 0, 0.1, 0.2, 0}));
}

}  // namespace tushar::collect
