#pragma once

#include <limits>

namespace tushar::data {

/// The first coordinate of a particle that no longer exists: the next relocation removes it.
inline constexpr double vanished = std::numeric_limits<double>::max();

}  // namespace tushar::data
