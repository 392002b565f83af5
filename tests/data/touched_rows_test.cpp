#include "core/data/touched_rows.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/data/particle_set.hpp"
#include "core/grid/grid.hpp"
#include "tests/support/levels.hpp"

namespace tushar::data {

namespace {

using grid::Box;

/// Particles on a grid of one patch: two in each of some cells.
template <class Holds>
ParticleSet particlesIn(const grid::Grid& grid, const Holds& holds) {
  ParticleSet set;
  set.reset(grid.patches().front(), 0);
  int count = 0;
  grid::forEach<3>(grid.level().cells(), [&](const Index3& cell) {
    const int first = count;
    if (holds(cell)) count += 2;
    set.at(cell) = {first, count};
  });
  set.setOwned(count);
  return set;
}

/// The first and the last node of each row of a box that belong to a cell with particles.
template <class Holds>
std::map<std::pair<int, int>, std::pair<int, int>> expectedRows(const Box& cells, const Box& nodes, int ghost,
                                                                int dimension, const Holds& holds) {
  std::map<std::pair<int, int>, std::pair<int, int>> rows;
  grid::forEach<3>(nodes, [&](const Index3& node) {
    bool isTouched = false;
    grid::forEach<3>(cells, [&](const Index3& cell) {
      bool touches = holds(cell);
      for (int d = 0; d < dimension; ++d) touches &= node[d] >= cell[d] - ghost && node[d] <= cell[d] + 1 + ghost;
      isTouched |= touches;
    });
    if (!isTouched) return;
    const auto [row, isNew] = rows.try_emplace({node[1], node[2]}, node[0], node[0]);
    if (!isNew) row->second.second = node[0];
  });
  return rows;
}

std::map<std::pair<int, int>, std::pair<int, int>> visitedRows(const TouchedRows& rows) {
  std::map<std::pair<int, int>, std::pair<int, int>> visited;
  rows.forEachRow([&](const Index3& first, int end) {
    EXPECT_TRUE(visited.try_emplace({first[1], first[2]}, first[0], end - 1).second);
  });
  return visited;
}

std::size_t nodesVisited(const TouchedRows& rows, const Box& within) {
  std::size_t count = 0;
  rows.forEachRow(within, [&](const Index3& first, int end) {
    EXPECT_TRUE(within.contains(first));
    count += static_cast<std::size_t>(end - first[0]);
  });
  return count;
}

bool isInTwoCorners(const Index3& cell) {
  return (cell[0] == 1 && cell[1] < 2 && cell[2] == 0) || (cell[0] > 3 && cell[0] < 6 && cell[1] == 4);
}

}  // namespace

TEST(TouchedRows, ReachFromTheFirstToTheLastNodeThatParticlesTouch) {
  for (const auto& [cells, dimension] : {std::pair(Index3{{7, 6, 5}}, 3), std::pair(Index3{{7, 6, 1}}, 2)})
    for (const int ghost : {0, 1}) {
      const grid::Grid grid(test::domain(cells));
      const ParticleSet set = particlesIn(grid, isInTwoCorners);
      const Box& all = grid.level().cells();
      for (const Box& nodes : {all.nodes(dimension), Box{{{2, 1, 0}}, {{6, 5, 1}}}}) {
        const TouchedRows rows(set, all, ghost, nodes, dimension);
        const auto expected = expectedRows(all, nodes, ghost, dimension, isInTwoCorners);
        EXPECT_FALSE(expected.empty());
        EXPECT_EQ(visitedRows(rows), expected);
      }
    }
}

TEST(TouchedRows, AreCutByABox) {
  const grid::Grid grid(test::domain({{7, 6, 5}}));
  const auto isInTheMiddle = [](const Index3& cell) { return cell == Index3{{3, 3, 2}}; };
  const Box& cells = grid.level().cells();
  const TouchedRows rows(particlesIn(grid, isInTheMiddle), cells, 1, cells.nodes(3), 3);

  EXPECT_EQ(nodesVisited(rows, cells.nodes(3)), 4u * 4 * 4);
  EXPECT_EQ(nodesVisited(rows, {{{4, 0, 0}}, {{8, 4, 3}}}), 2u * 2 * 2);
  EXPECT_EQ(nodesVisited(rows, {{{0, 0, 0}}, {{2, 7, 6}}}), 0u);
  EXPECT_EQ(nodesVisited(rows, {{{-5, 3, 3}}, {{20, 4, 4}}}), 4u);
}

TEST(TouchedRows, AreNoneWithoutParticlesAndAllWhereTheyAreNotKnown) {
  const grid::Grid grid(test::domain({{7, 6, 5}}));
  const Box nodes = grid.level().cells().nodes(3);

  EXPECT_EQ(nodesVisited(TouchedRows(), nodes), 0u);
  EXPECT_EQ(
      nodesVisited({particlesIn(grid, [](const Index3&) { return false; }), grid.level().cells(), 1, nodes, 3}, nodes),
      0u);
  EXPECT_EQ(nodesVisited(TouchedRows::all(nodes), nodes), nodes.size());
}

TEST(TouchedRows, AreFoundAnewWhenASetHasOtherParticles) {
  const grid::Grid grid(test::domain({{7, 6, 5}}));
  const Box& cells = grid.level().cells();
  const auto rowsOf = [&](const ParticleSet& set, int ghost) { return visitedRows(set.touched(ghost, 3)); };
  const auto anew = [&](const ParticleSet& set, int ghost) {
    return visitedRows({set, cells, ghost, cells.nodes(3).grown(ghost, 3), 3});
  };
  ParticleSet set = particlesIn(grid, isInTwoCorners);
  EXPECT_EQ(rowsOf(set, 0), anew(set, 0));
  EXPECT_EQ(rowsOf(set, 1), anew(set, 1));
  EXPECT_NE(rowsOf(set, 0), rowsOf(set, 1));

  const auto before = rowsOf(set, 0);
  set.reset(grid.patches().front(), 0);
  EXPECT_TRUE(rowsOf(set, 0).empty());
  set.at(Index3{{2, 2, 2}}) = {0, 3};
  set.setOwned(3);
  EXPECT_EQ(rowsOf(set, 0), anew(set, 0));
  EXPECT_NE(rowsOf(set, 0), before);
}

TEST(TouchedRows, FollowTheGhostsOfASet) {
  const grid::Grid grid(test::domain({{7, 6, 5}}, {{2, 1, 1}}));
  std::vector<ParticleSet> sets(2);
  for (std::size_t place : {0u, 1u}) sets[place].reset(grid.patches()[place], 1);
  const Index3 beside = grid.patches()[1].cells().lower;
  sets[1].at(beside) = {0, 2};
  sets[1].setOwned(2);
  EXPECT_TRUE(visitedRows(sets[0].touched(0, 3)).empty());

  sets[0].addGhosts({beside, beside + Index3::filled(1)}, sets[1], 10);
  EXPECT_EQ(nodesVisited(sets[0].touched(0, 3), grid.level().cells().nodes(3)), 8u);
  sets[0].markGhosts();
  sets[0].forgetGhosts();
  EXPECT_TRUE(visitedRows(sets[0].touched(0, 3)).empty());
}

}  // namespace tushar::data
