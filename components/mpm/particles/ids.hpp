#pragma once

#include <fmt/format.h>

#include <bit>

#include "components/mpm/particles/mixed.hpp"
#include "core/core.hpp"

namespace tushar::mpm {

/// How many names a cell has for the particles that start in it.
inline constexpr ParticleId idsOfCell = 1 << 16;

/// The id of the k-th particle that starts in a cell: its cell's number and its place there, so that it does not depend
/// on the patches. Throws InputError, at `where` in the scene, where the cell has no more names.
template <int D>
ParticleId idOf(const Level& level, const Index<D>& cell, ParticleId k, const Location& where) {
  if (k >= idsOfCell)
    throw InputError(
        {{where, "geom_object", fmt::format("a cell can hold {} particles; bodies fill one with more", idsOfCell)}});
  return level.cellNumber(cell) * idsOfCell + k;
}

/// The id of a new particle: it depends on its parent's id and place only, so it is the same on every layout.
inline ParticleId derivedId(ParticleId parent, double place) {
  constexpr ParticleId derived = ParticleId{1} << 63;
  return mixed(parent ^ mixed(std::bit_cast<std::uint64_t>(place))) | derived;
}

}  // namespace tushar::mpm
