#pragma once

#include "core/data/bound.hpp"

namespace tushar::data {

/// Rows of numbers in memory.
struct NumberRows {
  const double* first;
  std::size_t count;      ///< number of values in a row
  std::size_t rows;       ///< number of rows
  std::ptrdiff_t stride;  ///< distance from the start of a row to that of the next
};

/// Whether all numbers satisfy a bound, checked in one pass of vector instructions over all rows.
bool holds(Bound bound, const NumberRows& numbers);

}  // namespace tushar::data
