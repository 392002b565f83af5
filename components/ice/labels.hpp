#pragma once

#include "core/core.hpp"

namespace tushar::ice {

/// Labels of cell variables that need a specific heat of the gas, and of others that Uintah's ICE saves.
namespace c {
inline constexpr CellLabel<double> temperature{"c.temperature", "K", "temperature"};
inline constexpr CellLabel<double> specificVolume{"c.specificVolume", "m^3/kg", "volume per mass"};
inline constexpr CellLabel<double> soundSpeed{"c.soundSpeed", "m/s", "speed of sound"};
inline constexpr CellLabel<double> pressureAtEnd{"c.pressureAtEnd", "Pa", "pressure at the end of an implicit step"};
inline constexpr CellLabel<double> pressureChange{"c.pressureChange", "Pa", "change of pressure in an implicit step"};
}  // namespace c

namespace total {
inline constexpr ReductionLabel<Sum> internalEnergy{"TotalIntEng", "J", "internal energy in all cells"};
inline constexpr ReductionLabel<Maximum> iterations{"KrylovIterations", "1", "iterations of the linear solve"};
}  // namespace total

}  // namespace tushar::ice
