#pragma once

#include <limits>

namespace tushar::data {

/// The value of the first coordinate that marks a particle as gone: the next relocation removes it.
inline constexpr double vanished = std::numeric_limits<double>::max();
/// The value of the first coordinate that marks a particle that cannot be advanced any further: the next relocation
/// drops and counts it.
inline constexpr double removed = std::numeric_limits<double>::lowest();

}  // namespace tushar::data
