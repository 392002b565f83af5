#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "core/core.hpp"

namespace tushar::mpm {

/// The quantities that are drawn at random. Each has a stream of its own: otherwise a particle with many pores would
/// also have much damage.
enum class Drawing : std::uint64_t { threshold, yieldStress, damage, porosity };

/// The n-th of four random numbers in (0, 1) for a particle, n = 0 ... 3. It depends on the quantity, the seed and the
/// id only, so it is the same on every patch layout.
///
/// Two rounds of the bit mixer of Steele, Lea & Flood, OOPSLA 2014 (see mixed.hpp), but with its constant added before
/// each round, not once.
/// Results of existing scenes depend on these bits.
inline double drawn(Drawing drawing, int seed, ParticleId id, std::uint64_t n) {
  constexpr std::uint64_t step = 0x9e3779b97f4a7c15u, stride = 0xd1342543de82ef95u;
  std::uint64_t z = static_cast<std::uint64_t>(id) * 4 + n + step * static_cast<std::uint64_t>(seed + 1) +
                    stride * static_cast<std::uint64_t>(drawing);
  for (const auto& [shift, factor] : {std::pair{30, 0xbf58476d1ce4e5b9u}, std::pair{27, 0x94d049bb133111ebu}}) {
    z += step;
    z = (z ^ (z >> shift)) * factor;
  }
  z ^= z >> 31;
  return (static_cast<double>(z >> 11) + 0.5) * 0x1p-53;
}

/// A normally distributed number for a particle, by Box & Muller, Ann. Math. Stat. 29 (1958) 610, from the first two
/// numbers of drawn().
inline double drawnNormal(Drawing drawing, int seed, ParticleId id) {
  return std::sqrt(-2 * std::log(drawn(drawing, seed, id, 0))) *
         std::cos(2 * std::numbers::pi * drawn(drawing, seed, id, 1));
}

}  // namespace tushar::mpm
