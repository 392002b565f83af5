#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "components/mpmice/gas_in_cells.hpp"
#include "components/mpmice/mpmice.hpp"
#include "tests/euler/gas_box.hpp"

namespace tushar::mpmice {

/// The values of a box of cells or nodes.
template <class T>
struct Field {
  Field(const Box& of, const T& value) : box(of), values(of.size(), value) {}

  CellView<T> cells() { return {values.data(), box}; }
  CellView<const T> seen() const { return {values.data(), box}; }
  NodeView<T> nodes() { return {values.data(), box}; }
  NodeView<const T> seenNodes() const { return {values.data(), box}; }

  Box box;
  std::vector<T> values;
};

/// A gas and its volume fractions in the cells of a grid; initially 1, with density 1 and total energy 2.5.
template <int D>
struct GasFields {
  explicit GasFields(const Box& cells)
      : density(cells, 1), energy(cells, 2.5), free(cells, 1), momentum(cells, zero()), coverage(cells, zero()) {}

  GasInCells<D> gas() const {
    return {.held = {{density.seen(), momentum.seen(), energy.seen()}, {}, {}},
            .free = free.seen(),
            .coverage = coverage.seen()};
  }
  static Vec<D> zero() { return Vec<D>::Zero(); }

  Field<double> density, energy, free;
  Field<Vec<D>> momentum, coverage;
};

/// Returns a value from 0 to 1 that varies irregularly with the seed.
inline double wild(double seed) { return 0.5 + 0.5 * std::sin(97.1 * seed + 31.7 * std::sin(3.3 * seed)); }

/// Returns a box of `size` cells along each of D axes.
template <int D>
Box cube(int size) {
  Box box{{}, Index3::filled(1)};
  for (int d = 0; d < D; ++d) box.upper[d] = size;
  return box;
}

template <int D>
struct Axes : std::integral_constant<int, D> {};
using AllAxes = testing::Types<Axes<1>, Axes<2>, Axes<3>>;

}  // namespace tushar::mpmice
