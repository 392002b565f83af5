#pragma once

#include <limits>

namespace tushar::data {

/// The first coordinate of a particle that no longer exists: the next relocation removes it.
inline constexpr double vanished = std::numeric_limits<double>::max();
/// The first coordinate of a particle that cannot be continued: the next relocation drops it, and counts it.
inline constexpr double removed = std::numeric_limits<double>::lowest();

}  // namespace tushar::data
