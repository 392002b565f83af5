#pragma once

#include <limits>

namespace tushar::data {

/// The first coordinate of a particle that is no more: the next relocation drops it.
inline constexpr double vanished = std::numeric_limits<double>::max();

}  // namespace tushar::data
