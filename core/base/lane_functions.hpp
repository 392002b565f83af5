#pragma once

#include <cstring>

#include "core/base/lanes.hpp"

namespace tushar {

// Functions of the mathematical library for all lanes of a register at once. Results do not depend on the processor.

/// e^x for 0 <= x <= 700, relative error at most 2e-16: 2^n times the Taylor series of the rest, which is at most
/// ln 2 / 2.
inline Lanes exponential(Lanes x) {
  constexpr double shift = 0x1.8p52;  // after its addition, the last bits of a number are those of the next integer
  const Lanes shifted = x * Lanes(0x1.71547652b82fep0) + Lanes(shift), n = shifted - Lanes(shift);
  // ln 2 in two parts: the first has 32 bits, so that its products with n are exact.
  const Lanes rest = x - n * Lanes(0x1.62e42feep-1) - n * Lanes(0x1.a39ef35793c76p-33);
  Lanes sum = 1.0;
  for (int k = 13; k > 0; --k) sum = 1.0 + sum * rest * Lanes(1.0 / k);
  Lanes::Mask bits;
  const Lanes::Register all = shifted.values();
  std::memcpy(&bits, &all, sizeof bits);
  bits = (bits + 1023) << 52;
  Lanes::Register power;
  std::memcpy(&power, &bits, sizeof power);
  return sum * power;
}

}  // namespace tushar
