#pragma once

#include <algorithm>
#include <functional>

namespace tushar::mpm::solid {

/// Interpolates a function of p.color from a table: linearly between its entries, which are in order of increasing
/// `color`, and with constant values outside their range. The table has at least one entry.
template <class Table, class Value>
double valueByColor(const Table& table, double color, Value&& value) {
  const auto upper = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return color <= entry.color; });
  if (upper == table.begin()) return std::invoke(value, table.front());
  if (upper == table.end()) return std::invoke(value, table.back());
  const auto lower = std::prev(upper);
  const double share = (color - lower->color) / (upper->color - lower->color);
  return (1 - share) * std::invoke(value, *lower) + share * std::invoke(value, *upper);
}

/// Whether the colors of a table increase from entry to entry.
template <class Table>
bool growsInColor(const Table& table) {
  return std::adjacent_find(table.begin(), table.end(),
                            [](const auto& a, const auto& b) { return a.color >= b.color; }) == table.end();
}

}  // namespace tushar::mpm::solid
