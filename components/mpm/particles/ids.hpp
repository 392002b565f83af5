#pragma once

#include <fmt/format.h>

#include <bit>

#include "components/mpm/particles/mixed.hpp"
#include "core/core.hpp"

namespace tushar::mpm {

/// Number of particle ids per cell.
inline constexpr ParticleId idsOfCell = 1 << 16;

/// The id of the k-th particle placed in a cell at the start, from the index of the cell and k, so that it does not
/// depend on the patches. Throws InputError, at `where` in the scene, if k exceeds the ids of the cell.
template <int D>
ParticleId idOf(const Level& level, const Index<D>& cell, ParticleId k, const Location& where) {
  if (k >= idsOfCell)
    throw InputError(
        {{where, "geom_object",
          fmt::format("a cell can contain at most {} particles, but the bodies put more than that into one cell",
                      idsOfCell)}});
  return level.cellNumber(cell) * idsOfCell + k;
}

/// The id of a new particle; it depends only on the id of its parent and on its position along the `axis` of the split,
/// so that it is the same on every layout, and another one for a split at the same position along another axis.
inline ParticleId derivedId(ParticleId parent, double place, int axis) {
  constexpr ParticleId derived = ParticleId{1} << 63;
  return mixed(parent ^ mixed(std::bit_cast<std::uint64_t>(place) + static_cast<std::uint64_t>(axis))) | derived;
}

}  // namespace tushar::mpm
