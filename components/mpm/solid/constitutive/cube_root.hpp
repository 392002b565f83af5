#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "core/base/lanes.hpp"

namespace tushar::mpm::solid {

/// Returns x^(-2/3) for a positive normal number, accurate to one or two units in the last place; much faster than
/// std::cbrt.
///
/// A first guess at x^(-1/3) from the exponent, good to 4 %, then two steps y += y (r/3 + 2 r²/9 + 14 r³/81) with
/// r = 1 - x y³, each of which raises the error to its fourth power.
template <class Real>
[[gnu::always_inline]] inline Real inverseCubeRootSquared(const Real& x) {
  const auto guess = [](double number) {
    return std::bit_cast<double>(std::uint64_t{0x553ef0ff289dd796} - std::bit_cast<std::uint64_t>(number) / 3);
  };
  Real y;
  if constexpr (std::is_same_v<Real, Lanes>)
    y = Lanes::of([&](int lane) { return guess(x[lane]); });
  else
    y = guess(x);
  for (int step = 0; step < 2; ++step) {
    const Real r = 1 - x * y * y * y;
    y += y * r * (1.0 / 3 + r * (2.0 / 9 + r * (14.0 / 81)));
  }
  return y * y;
}

}  // namespace tushar::mpm::solid
