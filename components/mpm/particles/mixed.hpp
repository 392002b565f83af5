#pragma once

#include <cstdint>

namespace tushar::mpm {

/// Bit mixer of Steele, Lea & Flood, OOPSLA 2014 (SplitMix64): a bijection of 64-bit words.
constexpr std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace tushar::mpm
