#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "components/euler/rows.hpp"
#include "components/euler/state_views.hpp"
#include "core/tasks/broken_value.hpp"

namespace tushar::euler {

/// Whether the states of a row of cells are possible: all values are finite, rho > 0 and p + p_inf > 0. The last
/// condition is checked without division, as rho (E - p_inf) > |rho v|² / 2.
template <int D>
bool canBe(const StiffenedGas& gas, const double* density, const double* momentum, const double* totalEnergy,
           int count) {
  std::uint64_t broken = 0;
  for (int i = 0; i < count; ++i) {
    double squared = 0;
    for (int d = 0; d < D; ++d) squared += momentum[i * D + d] * momentum[i * D + d];
    const double energy = density[i] * (totalEnergy[i] - gas.pInfinity);
    const bool fine = (density[i] > 0) & (energy > 0.5 * squared) & (energy <= std::numeric_limits<double>::max());
    broken |= static_cast<std::uint64_t>(!fine);
  }
  return broken == 0;
}
/// Whether the states of a row of cells are possible for a gas with its own law: its density is positive and finite,
/// and the law allows its energy.
template <int D, class Law>
bool canBe(const Law& law, const double* density, const double* momentum, const double* totalEnergy, int count) {
  for (int i = 0; i < count; ++i) {
    double squared = 0;
    for (int d = 0; d < D; ++d) squared += momentum[i * D + d] * momentum[i * D + d];
    if (!(density[i] > 0) || !(density[i] <= std::numeric_limits<double>::max())) return false;
    if (!law.canBe(density[i], totalEnergy[i] - 0.5 * squared / density[i])) return false;
  }
  return true;
}
template <int D>
bool canBe(const Gas& gas, const double* density, const double* momentum, const double* totalEnergy, int count) {
  return gas.withLaw([&](const auto& law) { return canBe<D>(law, density, momentum, totalEnergy, count); });
}

/// Internal energy per volume of a cell, E - rho v² / 2 [J/m³].
template <int D, class T>
double internalEnergyIn(const StateViews<D, T>& state, const Index<D>& cell) {
  return state.totalEnergy[cell] - 0.5 * state.momentum[cell].squaredNorm() / state.density[cell];
}

/// Pressure of a cell [Pa].
template <int D, class T>
double pressureIn(const Gas& gas, const StateViews<D, T>& state, const Index<D>& cell) {
  return gas.pressure(state.density[cell], internalEnergyIn<D, T>(state, cell));
}

/// Throws NumericalError for a cell with an impossible state. `before` is the state at the start of the step, with at
/// least one ghost cell, or null.
template <int D, class T>
[[noreturn]] void refuseState(const Level& level, const Gas& gas, const Index<D>& cell, const StateViews<D, T>& state,
                              const StateViews<D, const double>* before) {
  const bool ofDensity = !(state.density[cell] > 0 && std::isfinite(state.density[cell]));
  const auto energyIn = [](const auto& of, const Index<D>& at) { return internalEnergyIn<D>(of, at) / of.density[at]; };
  const auto number = [&](const auto& of, const Index<D>& at) {
    const double value = ofDensity ? of.density[at] : gas.law ? energyIn(of, at) : pressureIn(gas, of, at);
    return std::isnan(value) ? std::string("nan") : fmt::format("{:.6g}", value);
  };
  const auto nameOf = [&](const Index<D>& at) {
    Index3 wide;
    for (int d = 0; d < D; ++d) wide[d] = at[d];
    return tasks::nameOf(level, wide);
  };
  const std::string label = ofDensity ? "c.density" : gas.law ? "c.internalEnergy" : "c.pressure";
  const char* unit = ofDensity ? "kg/m^3" : gas.law ? "J/kg" : "Pa";
  const auto limits = [&] {
    if (ofDensity || !gas.law) return fmt::format("{:g}", ofDensity ? 0 : 0 - gas.pInfinity);
    const auto [least, most] = gas.energyLimits(state.density[cell]);
    return std::isinf(most) ? fmt::format("{:g}", least) : fmt::format("{:g} and less than {:g}", least, most);
  };
  std::string text = fmt::format("{} became {} {}", label, number(state, cell), unit);
  if (before) text += " from " + number(*before, cell);
  text +=
      fmt::format(", but must be finite and greater than {}: {} at x = {}", limits(), nameOf(cell), D > 1 ? "(" : "");
  for (int d = 0; d < D; ++d) text += fmt::format("{}{:.6g}", d ? ", " : "", level.cellCentre<D>(cell)[d]);
  text += D > 1 ? ") m" : " m";
  if (!ofDensity) text += fmt::format(", density {:.6g} kg/m^3", state.density[cell]);
  const char* separator = "; around it before the step: ";
  for (int k = 0; before && k < 2 * D; ++k) {
    const Index<D> next = k % 2 == 0 ? cell - Index<D>::unit(k / 2) : cell + Index<D>::unit(k / 2);
    if (!level.cells().contains(next)) continue;
    text += separator + number(*before, next) + " in " + nameOf(next);
    separator = ", ";
  }
  throw NumericalError(text, "", label, level.cellNumber<D>(cell));
}

// Compiled only in `euler`, also for the components that are built from it.
#define TUSHAR_REFUSE_STATE(WORD, D, T)                                                              \
  WORD template void refuseState(const Level&, const Gas&, const Index<D>&, const StateViews<D, T>&, \
                                 const StateViews<D, const double>*);
#define TUSHAR_REFUSE_STATES(WORD, D) TUSHAR_REFUSE_STATE(WORD, D, double) TUSHAR_REFUSE_STATE(WORD, D, const double)
TUSHAR_REFUSE_STATES(extern, 1)
TUSHAR_REFUSE_STATES(extern, 2)
TUSHAR_REFUSE_STATES(extern, 3)

/// Whether the state of a cell is possible.
template <int D, class T>
bool isPossible(const Gas& gas, const StateViews<D, T>& state, const Index<D>& cell) {
  return canBe<D>(gas, &state.density[cell], state.momentum[cell].data(), &state.totalEnergy[cell], 1) &&
         (gas.law || pressureIn(gas, state, cell) + gas.pInfinity > 0);
}

/// Throws NumericalError for the first cell of the patch with an impossible state, if there is one.
template <int D, class T>
void refuseBroken(const Patch& patch, const Gas& gas, const StateViews<D, T>& state,
                  const StateViews<D, const double>* before) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!isPossible<D, T>(gas, state, cell)) refuseState<D>(patch.level(), gas, cell, state, before);
  });
}

/// The first cell, in the order of errors, in any of some boxes for which a test fails.
template <int D, class Test>
std::optional<Index<D>> firstFailing(const Level& level, const std::vector<Box>& boxes, const Test& test) {
  std::optional<Index<D>> first;
  for (const Box& box : boxes)
    forEach<D>(box, [&](const Index<D>& cell) {
      if (!test(cell) && (!first || level.cellNumber<D>(cell) < level.cellNumber<D>(*first))) first = cell;
    });
  return first;
}

/// Throws NumericalError if refluxing has made the state of a cell beside finer cells impossible.
template <int D>
void checkRefluxed(const Patch& patch, const Gas& gas, const std::vector<Box>& besideFiner,
                   const ChangedState<D>& state) {
  const auto isFine = [&](const Index<D>& cell) { return isPossible<D, double>(gas, state, cell); };
  if (const auto cell = firstFailing<D>(patch.level(), besideFiner, isFine))
    refuseState<D, double>(patch.level(), gas, *cell, state, nullptr);
}

}  // namespace tushar::euler
