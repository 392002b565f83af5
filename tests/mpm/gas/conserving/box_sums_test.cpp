#include "components/mpm/gas/conserving/box_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/mpm/gas/conserving/boxes.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

struct OneBox {
  Vec<2> x, edges;
  double mass;
};

/// Up to four boxes in each cell, at distances from the middle of the grid whose negatives are exact.
std::vector<OneBox> randomBoxes(const Level& level) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<OneBox> boxes;
  forEach<2>(level.cells(), [&](const Index<2>& cell) {
    for (int k = (3 * cell[0] + cell[1]) % 5; k > 0; --k) {
      OneBox box{.x = {}, .edges = {}, .mass = uniform(generator)};
      for (int d = 0; d < 2; ++d) {
        const double offset = fromMiddle<double>(level, d, cell[d]) + 0.9 * uniform(generator) - 0.45;
        box.x[d] = middleOf(level, d) + std::ldexp(std::round(std::ldexp(offset * level.spacing(d), 20)), -20);
        box.edges[d] = (0.1 + 1.7 * uniform(generator)) * level.spacing(d);
      }
      boxes.push_back(box);
    }
  });
  return boxes;
}

/// Boxes, in the cells of their centres.
struct Boxes : test::Particles {
  std::vector<Vec<2>> x, edges;
  std::vector<double> mass;

  explicit Boxes(const std::vector<OneBox>& boxes) : Particles(test::unitCells(11, 7)) {
    set.reset(patch(), 0);
    forEach<2>(level.cells(), [&](const Index<2>& cell) {
      const int first = static_cast<int>(x.size());
      for (const OneBox& box : boxes) {
        if (level.cellOf<2>(box.x) != cell) continue;
        x.push_back(box.x);
        edges.push_back(box.edges);
        mass.push_back(box.mass);
      }
      set.at(cell) = {first, static_cast<int>(x.size())};
    });
    set.setOwned(static_cast<int>(x.size()));
  }
  /// The mass at each node.
  std::vector<double> massAtNodes() const {
    NodeValues<double> nodes(level);
    const auto at = read(x), size = read(edges);
    const auto m = read(mass);
    const CellsOf<2> cells(level);
    const RowsAround<2> around(patch(), at.cells(), 1);
    BoxSums<2, 1, 1> sums(around.rows, around.blocks);
    const auto visit = [&](const Batch<2>& batch) {
      const Footprint<2> footprint(cells, batch, load(at, batch), load(size, batch));
      const std::size_t first = sums.firstOf(footprint), count = static_cast<std::size_t>(footprint.along[0].nodes());
      footprint.forEachRowOfNodes({}, [&](const Index<2>& k, const Lanes& w, const Footprint<2>::Field<0>&) {
        BoxSums<2, 1, 1>::Terms terms{};
        for (std::size_t n = 0; n < count; ++n)
          terms[first + n] = footprint.along[0].weight[n] * w * batch.only(load(m, batch));
        sums.add(footprint, k, [&](std::size_t) { return terms; });
      });
    };
    const auto finish = [&](const Index<2>& row) {
      forEachPartOfRow<2>(nodes.box, row,
                          [&](const RowPart<2>& part) { store(sums.readRow(0, part.first), nodes.write(), part); });
    };
    sumOverBoxes<2>(around, at, visit, finish, sums);
    std::vector<double> all;
    forEach<2>(nodes.box, [&](const Index<2>& node) { all.push_back(nodes.read()[node]); });
    return all;
  }
};

}  // namespace

TEST(BoxSums, AreThoseOfOneBoxAfterTheOther) {
  const std::vector<OneBox> boxes = randomBoxes(Level(test::unitCells(11, 7)));
  const std::vector<double> together = Boxes(boxes).massAtNodes();
  std::vector<double> apart(together.size());
  double all = 0;
  for (const OneBox& box : boxes) {
    const std::vector<double> one = Boxes({box}).massAtNodes();
    for (std::size_t n = 0; n < one.size(); ++n) apart[n] += one[n];
    all += box.mass;
  }
  for (std::size_t n = 0; n < together.size(); ++n) EXPECT_NEAR(together[n], apart[n], 1e-14);
  EXPECT_NEAR(std::accumulate(together.begin(), together.end(), 0.0), all, 1e-12);
}

TEST(BoxSums, DoNotDependOnTheOrderOfTheParticlesOfACell) {
  std::vector<OneBox> boxes = randomBoxes(Level(test::unitCells(11, 7)));
  const std::vector<double> forwards = Boxes(boxes).massAtNodes();
  std::reverse(boxes.begin(), boxes.end());
  EXPECT_EQ(Boxes(boxes).massAtNodes(), forwards);
}

TEST(BoxSums, OfTheMirrorImageAreMirrored) {
  const Level level(test::unitCells(11, 7));
  std::vector<OneBox> boxes = randomBoxes(level);
  std::vector<double> expected = Boxes(boxes).massAtNodes();
  for (OneBox& box : boxes)
    for (int d = 0; d < 2; ++d) box.x[d] = 2 * middleOf(level, d) - box.x[d];
  std::reverse(expected.begin(), expected.end());
  EXPECT_EQ(Boxes(boxes).massAtNodes(), expected);
}

}  // namespace tushar::mpm::gas::conserving
