#include "core/data/bound.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tushar::data {

namespace {

constexpr std::uint64_t infinity = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
constexpr std::uint64_t allButSign = ~std::uint64_t{0} >> 1;

/// The greatest `key` of the bits of the numbers; lanes that do not wait for one another, for vector instructions.
template <class Key>
std::uint64_t greatest(const double* values, std::size_t count, Key key) {
  constexpr std::size_t width = 32;
  std::array<std::uint64_t, width> lanes{};
  std::size_t k = 0;
  for (; k + width <= count; k += width)
    for (std::size_t lane = 0; lane < width; ++lane)
      lanes[lane] = std::max(lanes[lane], key(std::bit_cast<std::uint64_t>(values[k + lane])));
  for (; k < count; ++k) lanes[0] = std::max(lanes[0], key(std::bit_cast<std::uint64_t>(values[k])));
  return *std::max_element(lanes.begin(), lanes.end());
}

}  // namespace

bool holds(Bound bound, double value) {
  if (bound == Bound::none) return true;
  return std::isfinite(value) && (bound != Bound::positive || value > 0) && (bound != Bound::nonNegative || value >= 0);
}

// As integers, the bits of numbers from 0 up are in the order of the numbers; not a number comes above infinity, and
// what has a sign above that. One less, 0 comes above all.
bool holds(Bound bound, const double* values, std::size_t count) {
  switch (bound) {
    case Bound::none: return true;
    case Bound::finite: return greatest(values, count, [](std::uint64_t b) { return b & allButSign; }) < infinity;
    case Bound::positive: return greatest(values, count, [](std::uint64_t b) { return b - 1; }) < infinity - 1;
    default: break;
  }
  if (greatest(values, count, [](std::uint64_t b) { return b; }) < infinity) return true;
  return std::all_of(values, values + count, [&](double x) { return holds(bound, x); });  // perhaps it is only a -0
}

std::string_view textOf(Bound bound) {
  return bound == Bound::positive ? "greater than 0" : bound == Bound::nonNegative ? "at least 0" : "finite";
}

}  // namespace tushar::data
