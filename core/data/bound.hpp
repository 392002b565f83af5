#pragma once

#include <cstddef>
#include <string_view>

namespace tushar::data {

/// A limit that all values of a variable must satisfy, whichever task writes them.
enum class Bound { none, finite, nonNegative, positive };

/// Whether a number satisfies a bound. A number that is not finite satisfies only Bound::none.
bool holds(Bound bound, double value);
/// Whether all `count` numbers satisfy a bound, checked in one pass of vector instructions.
bool holds(Bound bound, const double* values, std::size_t count);
/// The bound in words: `finite`, `at least 0`, `greater than 0`.
std::string_view textOf(Bound bound);

}  // namespace tushar::data
