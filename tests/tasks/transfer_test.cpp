#include "core/tasks/transfer.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/base/limiters.hpp"

namespace tushar::tasks {

namespace {

using grid::Box;

std::vector<double> anyNumbers(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> between(-1, 1);
  std::vector<double> numbers(count);
  for (double& number : numbers) number = between(random);
  return numbers;
}

CellValues valuesOf(std::vector<double>& numbers, const Box& stored) {
  return {reinterpret_cast<std::byte*>(numbers.data()), stored};
}

data::Label labelOf(int components) {
  static constexpr data::CellLabel<double> one{"c.one", "1", "a number"};
  data::Label label = one;
  label.components = components;
  label.bytes = static_cast<std::size_t>(components) * sizeof(double);
  return label;
}

/// A box of coarse cells, and the cells whose values are known.
struct Coarse {
  Box stored;
  int dimension;
};

std::vector<Coarse> coarseBoxes() {
  return {{{{{-2, 0, 0}}, {{11, 1, 1}}}, 1}, {{{{-2, 3, 0}}, {{11, 9, 1}}}, 2}, {{{{-2, 3, 1}}, {{11, 9, 5}}}, 3}};
}

/// A quarter of the slope of a number of a coarse cell along an axis; 0 if a neighbour is not stored.
double quarterSlope(const std::vector<double>& coarse, const Box& stored, int components, const Index3& cell, int axis,
                    int number) {
  const auto at = [&](const Index3& of) {
    return coarse[stored.offset(of) * static_cast<std::size_t>(components) + static_cast<std::size_t>(number)];
  };
  const Index3 below = cell - Index3::unit(axis), above = cell + Index3::unit(axis);
  if (!stored.contains(below) || !stored.contains(above)) return 0;
  return 0.25 * Mc::slope(at(cell) - at(below), at(above) - at(cell));
}

/// Boxes of finer cells in which rows are narrow or wide compared to what is stored.
std::vector<Box> partsOf(const Box& all, int dimension) {
  std::vector<Box> parts{all};
  for (int d = 0; d < dimension; ++d) {
    for (const int from : {0, 1, 2, 3})
      for (const int width : {1, 2, 3, 5}) {
        Box part = all;
        part.lower[d] += from;
        part.upper[d] = part.lower[d] + width;
        parts.push_back(part);
      }
    Box inside = all;
    inside.lower[d] += 2;
    inside.upper[d] -= 2;
    parts.push_back(inside);
  }
  return parts;
}

}  // namespace

TEST(Prolongation, AddsLimitedSlopesToTheParent) {
  for (const auto& [stored, dimension] : coarseBoxes())
    for (const int components : {1, 2, 3, 4}) {
      const data::Label label = labelOf(components);
      std::vector<double> coarse = anyNumbers(stored.size() * static_cast<std::size_t>(components));
      const Box all = stored.refined(dimension);
      for (const Box& box : partsOf(all, dimension)) {
        std::vector<double> fine(all.size() * static_cast<std::size_t>(components), 7), expected = fine;
        grid::forEach<3>(box, [&](const Index3& cell) {
          const Index3 parent = Box{cell, cell + Index3::filled(1)}.coarsened(dimension).lower;
          for (int k = 0; k < components; ++k) {
            double value =
                coarse[stored.offset(parent) * static_cast<std::size_t>(components) + static_cast<std::size_t>(k)];
            for (int d = 0; d < dimension; ++d) {
              const double quarter = quarterSlope(coarse, stored, components, parent, d, k);
              value += cell[d] == 2 * parent[d] ? -quarter : quarter;
            }
            expected[all.offset(cell) * static_cast<std::size_t>(components) + static_cast<std::size_t>(k)] = value;
          }
        });
        prolong(label, dimension, valuesOf(coarse, stored), box, valuesOf(fine, all));
        EXPECT_EQ(fine, expected);
      }
    }
}

TEST(Prolongation, OfARowHasTheBitsOfThatOfEachCell) {
  for (const auto& [stored, dimension] : coarseBoxes())
    for (const int components : {1, 2, 3, 4}) {
      const data::Label label = labelOf(components);
      std::vector<double> coarse = anyNumbers(stored.size() * label.bytes / sizeof(double));
      const Box all = stored.refined(dimension);
      for (const bool areAllInside : {true, false}) {
        Box box = all;
        for (int d = 0; d < dimension && !areAllInside; ++d)
          ++box.lower[d];  // the first cells have half their children
        std::vector<double> fine(all.size() * static_cast<std::size_t>(components), 7), expected = fine;
        prolong(label, dimension, valuesOf(coarse, stored), box, valuesOf(fine, all));
        grid::forEach<3>(box, [&](const Index3& cell) {
          const Box one{cell, cell + Index3::filled(1)};
          prolong(label, dimension, valuesOf(coarse, stored), one, valuesOf(expected, all));
        });
        EXPECT_EQ(fine, expected);
      }
    }
}

TEST(Restriction, IsTheMeanOfTheChildrenInPairs) {
  for (const auto& [stored, dimension] : coarseBoxes())
    for (const int components : {1, 2, 3, 4}) {
      const data::Label label = labelOf(components);
      const Box all = stored.refined(dimension);
      std::vector<double> fine = anyNumbers(all.size() * static_cast<std::size_t>(components));
      std::vector<double> means(stored.size() * static_cast<std::size_t>(components), 7), expected = means;
      Box box = stored;
      ++box.lower[0];
      if (dimension > 1) --box.upper[1];
      restrictTo(label, dimension, box, valuesOf(fine, all), valuesOf(means, stored));
      grid::forEach<3>(box, [&](const Index3& cell) {
        for (int k = 0; k < components; ++k) {
          const auto child = [&](int x, int y, int z) {
            Index3 at = cell;
            for (int d = 0; d < dimension; ++d) at[d] *= 2;
            return fine[all.offset(at + Index3{{x, y, z}}) * static_cast<std::size_t>(components) +
                        static_cast<std::size_t>(k)];
          };
          const auto pair = [&](int y, int z) { return child(0, y, z) + child(1, y, z); };
          double mean = 0.5 * pair(0, 0);
          if (dimension == 2) mean = 0.25 * (pair(0, 0) + pair(1, 0));
          if (dimension == 3) mean = 0.125 * ((pair(0, 0) + pair(1, 0)) + (pair(0, 1) + pair(1, 1)));
          expected[stored.offset(cell) * static_cast<std::size_t>(components) + static_cast<std::size_t>(k)] = mean;
        }
      });
      EXPECT_EQ(means, expected);
    }
}

}  // namespace tushar::tasks
