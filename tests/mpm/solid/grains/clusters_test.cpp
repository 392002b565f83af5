#include "components/mpm/solid/grains/clusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tushar::mpm::solid {

namespace {

/// Square particles of a block of n x n cells, in one material; `edge` is the length of their edges.
void addBlock(std::vector<GrainBox>& boxes, int n, double left, double edge, int material, int type = 0) {
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      GrainBox& box = boxes.emplace_back();
      box.id = boxes.size();
      box.material = material;
      box.type = type;
      box.centre = {left + i, 0.5 + j, 0};
      box.half = {0.5 * edge, 0.5 * edge, 0};
    }
  std::sort(boxes.begin(), boxes.end());
}

std::size_t countOf(std::vector<int> clusters) {
  std::sort(clusters.begin(), clusters.end());
  return static_cast<std::size_t>(std::unique(clusters.begin(), clusters.end()) - clusters.begin());
}

std::vector<int> nextOf(const std::vector<GrainBox>& boxes, const std::vector<Grain>& materials) {
  return materialsOfClusters(boxes, clustersOf(boxes, {.dimension = 2}), materials);
}

const Grain touching{0, true, true}, free{0, false, true};

/// Clusters found by comparing all pairs until nothing changes.
std::vector<int> slowly(const std::vector<GrainBox>& boxes, const GrainSpace& space) {
  std::vector<int> first(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) first[k] = static_cast<int>(k);
  for (bool changes = true; changes;) {
    changes = false;
    for (std::size_t a = 0; a < boxes.size(); ++a)
      for (std::size_t b = 0; b < boxes.size(); ++b) {
        bool meet = true;
        for (int d = 0; d < space.dimension; ++d) {
          double apart = std::abs(boxes[a].centre[d] - boxes[b].centre[d]);
          if (space.period[d] > 0) apart = std::min(apart, std::abs(space.period[d] - apart));
          meet = meet && apart <= boxes[a].half[d] + boxes[b].half[d];
        }
        if (!meet || first[a] <= first[b]) continue;
        first[a] = first[b];
        changes = true;
      }
  }
  return first;
}

/// Two blocks of particles one apart, whose density at the start is 1.21 times the critical one, so that their edges
/// become 1.1 (in two dimensions), separate once the distance of their nearest particles exceeds 1.1.
TEST(GrainClusters, blocksSeparateAtTheCriticalDensity) {
  const double edge = std::sqrt(1.21);
  for (const double apart : {0.5, 1.0, 1.0999, 1.1001, 3.0, 1000.0}) {
    std::vector<GrainBox> boxes;
    addBlock(boxes, 3, 0, edge, 0);
    addBlock(boxes, 3, 2 + apart, edge, 0);
    EXPECT_EQ(countOf(clustersOf(boxes, {.dimension = 2})), apart < 1.1 ? 1U : 2U) << apart;
  }
}

TEST(GrainClusters, areThoseOfAllPairs) {
  std::mt19937 random(1);
  for (const int dimension : {1, 2, 3})
    for (const double period : {0.0, 1.0})
      for (const double edge : {0.003, 0.05, 0.2, 0.6}) {
        std::uniform_real_distribution<double> place(0, 1), size(0.2 * edge, edge);
        std::vector<GrainBox> boxes(150);
        GrainSpace space{.dimension = dimension};
        for (int d = 0; d < dimension; ++d) space.period[d] = period;
        for (std::size_t k = 0; k < boxes.size(); ++k) {
          boxes[k].id = k;
          for (int d = 0; d < dimension; ++d) {
            boxes[k].centre[d] = place(random);
            boxes[k].half[d] = 0.5 * size(random);
          }
        }
        EXPECT_EQ(clustersOf(boxes, space), slowly(boxes, space)) << dimension << ' ' << period << ' ' << edge;
      }
}

TEST(GrainClusters, ofNothingAreNone) { EXPECT_TRUE(clustersOf({}, {.dimension = 2}).empty()); }

TEST(GrainMaterials, theLargerPartKeepsTheMaterial) {
  std::vector<GrainBox> boxes;
  addBlock(boxes, 2, 0, 1.05, 1);
  addBlock(boxes, 3, 10, 1.05, 1);
  const std::vector<int> next = nextOf(boxes, {touching, free, free});
  for (std::size_t k = 0; k < boxes.size(); ++k) EXPECT_EQ(next[k], k < 4 ? 2 : 1);
}

TEST(GrainMaterials, blocksThatMeetBecomeOne) {
  std::vector<GrainBox> boxes;
  addBlock(boxes, 3, 0, 1.05, 2);
  addBlock(boxes, 2, 3, 1.05, 1);
  EXPECT_EQ(nextOf(boxes, {touching, free, free}), std::vector<int>(13, 2));
}

TEST(GrainMaterials, blocksOnAWallNeedContacts) {
  std::vector<GrainBox> boxes;
  addBlock(boxes, 2, 0, 1.05, 1);
  addBlock(boxes, 2, 2, 1.05, 3, 7);
  const Grain wall{7, true, false};
  EXPECT_EQ(nextOf(boxes, {touching, free, free, wall}), (std::vector<int>{0, 0, 0, 0, 3, 3, 3, 3}));
  EXPECT_EQ(nextOf(boxes, {free, free, touching, wall}), (std::vector<int>{2, 2, 2, 2, 3, 3, 3, 3}));
}

TEST(GrainMaterials, whatMayNotSplitStays) {
  std::vector<GrainBox> boxes;
  addBlock(boxes, 2, 0, 1.05, 0);
  addBlock(boxes, 2, 10, 1.05, 0);
  EXPECT_EQ(nextOf(boxes, {{0, true, false}}), std::vector<int>(8, 0));
}

TEST(GrainMaterials, tooFewOfThemAreRefused) {
  std::vector<GrainBox> boxes;
  addBlock(boxes, 2, 0, 1.05, 0);
  addBlock(boxes, 2, 10, 1.05, 0);
  EXPECT_THROW(nextOf(boxes, {free}), NumericalError);
  EXPECT_THROW(nextOf(boxes, {free, touching}), NumericalError);
  EXPECT_NO_THROW(nextOf(boxes, {free, touching, free}));
}

TEST(GrainMaterials, equalIdsAreRefused) {
  std::vector<GrainBox> boxes;
  addBlock(boxes, 2, 0, 1.05, 0);
  boxes[1].id = boxes[0].id;
  EXPECT_THROW(nextOf(boxes, {free}), NumericalError);
}

}  // namespace

}  // namespace tushar::mpm::solid
