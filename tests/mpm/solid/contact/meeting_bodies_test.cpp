#include "components/mpm/solid/contact/meeting_bodies.hpp"

#include <gtest/gtest.h>

#include "tests/support/levels.hpp"

// Which bodies meet at which nodes, on plain fields.

namespace tushar::mpm::solid {
namespace {

// On a grid of 3 x 1 cells, body 0 has mass up to x = 2, body 1 from x = 1, and body 3 at x = 2; material 2 has none.
TEST(MeetingBodies, AreThoseWithMassAtANodeInTheOrderOfTheirIndices) {
  const Grid grid(test::unitCells(3, 1));
  const Box nodes = grid.level().nodes();
  std::array<std::vector<NodeRecord>, 4> records;
  std::vector<NodeView<const NodeRecord>> views;
  for (auto& of : records) {
    of.assign(nodes.size(), NodeRecord{});
    views.emplace_back(of.data(), nodes);
  }
  const auto place = [&](std::size_t body, std::initializer_list<int> columns) {
    for (const int x : columns) records[body][nodes.offset(Index3{{x, 0, 0}})][lane::mass] = 1;
  };
  place(0, {0, 1, 2});
  place(1, {1, 2, 3});
  place(3, {2});
  const data::TouchedRows all = data::TouchedRows::all(nodes);
  const MeetingBodies<2> meeting(nodes, {0, 1, 3}, {&all, &all, nullptr, &all}, views);
  std::vector<std::pair<Index<2>, std::vector<std::size_t>>> found;
  meeting.forEachNode([&](const Index<2>& node, std::span<const std::size_t> bodies) {
    found.emplace_back(node, std::vector<std::size_t>(bodies.begin(), bodies.end()));
  });
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0], (std::pair{Index<2>{{1, 0}}, std::vector<std::size_t>{0, 1}}));
  EXPECT_EQ(found[1], (std::pair{Index<2>{{2, 0}}, std::vector<std::size_t>{0, 1, 3}}));
}

}  // namespace
}  // namespace tushar::mpm::solid
