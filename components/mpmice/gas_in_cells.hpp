#pragma once

#include <algorithm>
#include <array>

#include "components/euler/tasks/advance_mixture.hpp"
#include "components/euler/tasks/check_state.hpp"
#include "components/mpmice/labels.hpp"
#include "components/mpmice/settings.hpp"

namespace tushar::mpmice {

/// The content of the gas, per volume of the gas itself: rho, rho v, E and, for several gases, the mass and the volume
/// fraction of each.
template <int D>
struct Parcel {
  euler::State<D> u{};
  std::array<double, euler::kMostGases> masses{}, shares{};

  void add(const Parcel& other, double factor) {
    for (std::size_t k = 0; k < u.size(); ++k) u[k] += factor * other.u[k];
    for (std::size_t k = 0; k < masses.size(); ++k) {
      masses[k] += factor * other.masses[k];
      shares[k] += factor * other.shares[k];
    }
  }
};

/// The equilibrium of gases with laws of their own in the free volume of a cell that contains gas.
template <int D, class T>
euler::Blend blendAt(const Settings& settings, const euler::MixtureViews<D, T>& held, double free,
                     const Index<D>& cell) {
  std::array<double, euler::kMostGases> masses{}, shares{};
  for (std::size_t k = 0; k < held.masses.size(); ++k) {
    masses[k] = held.masses[k][cell] / free;
    shares[k] = held.shares[k][cell];
  }
  return settings.gases.front().blend->at(masses.data(), euler::internalEnergyIn<D, T>(held, cell) / free,
                                          shares.data());
}

/// Whether one of several gases is neither ideal nor stiffened.
inline bool areBlended(const Settings& settings) { return !settings.gases.empty() && settings.gases.front().blend; }

/// The law of the gas in a cell; for several gases, that of the stiffened gas equivalent to their mixture. `free` is
/// the free volume of the cell.
template <int D, class T>
euler::Gas lawAt(const Settings& settings, const euler::MixtureViews<D, T>& held, double free, const Index<D>& cell) {
  if (settings.gases.empty()) return settings.gas.gas;
  if (areBlended(settings)) {
    if (free < leastFreeVolume || !(held.density[cell] > 0)) return {};
    return blendAt<D, T>(settings, held, free, cell).law(euler::internalEnergyIn<D, T>(held, cell) / free).alike();
  }
  euler::MixedGas mixed;
  for (std::size_t k = 0; k < settings.gases.size(); ++k)
    mixed.add(held.shares[k][cell], settings.gases[k].gas.gamma, settings.gases[k].gas.pInfinity);
  return mixed.alike();
}

/// Views of one variable for each of several gases.
template <class Take, class Access>
auto viewsOfGases(Take& take, std::size_t gases, Access&& access) {
  std::vector<std::decay_t<decltype(take(access(0)))>> views;
  for (std::size_t k = 0; k < gases; ++k) views.push_back(take(access(k)));
  return views;
}

/// The gas in the free part of cells: its content, per cell volume, and the free volume. For several gases, the masses
/// are also per cell volume, but volume fractions refer to the volume of the gas.
template <int D>
struct GasInCells {
  euler::MixtureViews<D, const double> held;
  CellView<const double> free;
  CellView<const Vec<D>> coverage;
  std::optional<CellView<const Vec<D>>> coverageAtEnd = {};  ///< if an upper side of the grid is a symmetry plane

  /// How many ghost layers are needed for the state, for the presence of gas, and for the free volume.
  struct Reach {
    int state = 0, mass = 0, room = 0;
    std::size_t gases = 0;     ///< number of gases if there are several, otherwise 0
    bool endsAtPlane = false;  ///< as in Settings
  };
  /// `reads` makes the accesses to the state, which is that at the start of a step, or the one computed in the step.
  static GasInCells from(auto& take, auto reads, const Reach& ghost) {
    const auto ofEach = [&](const auto& labels) {
      return viewsOfGases(take, ghost.gases, [&](std::size_t k) { return reads(labels[k], ghost.state); });
    };
    return {.held = {{take(reads(c::density, ghost.mass)), take(reads(c::momentum<D>, ghost.state)),
                      take(reads(c::totalEnergy, ghost.state))},
                     ofEach(c::massOfGas),
                     ofEach(c::shareOfGas)},
            .free = take(reads(c::freeVolume, ghost.room)),
            .coverage = take(reads(c::coverage<D>, ghost.room)),
            .coverageAtEnd = take(when(ghost.endsAtPlane, reads(c::coverageAtEnd<D>, ghost.room)))};
  }
  bool isEmpty(const Index<D>& cell) const { return free[cell] < leastFreeVolume || !(held.density[cell] > 0); }
  /// Whether a cell contains a body or contains no gas.
  bool hasBody(const Index<D>& cell) const { return free[cell] < wholeFreeVolume || isEmpty(cell); }
  /// Rho, rho v, E per volume of the gas, in a cell that contains gas.
  euler::State<D> conserved(const Index<D>& cell) const {
    const double inverse = 1 / free[cell];
    euler::State<D> u;
    u[euler::kDensity] = held.density[cell] * inverse;
    for (int d = 0; d < D; ++d) u[euler::kVelocity(d)] = held.momentum[cell][d] * inverse;
    u[euler::kPressure<D>] = held.totalEnergy[cell] * inverse;
    return u;
  }
  /// Like `conserved`, including the content of each of several gases.
  Parcel<D> parcel(const Index<D>& cell) const {
    Parcel<D> parcel{conserved(cell)};
    for (std::size_t k = 0; k < held.shares.size(); ++k) {
      parcel.masses[k] = held.masses[k][cell] / free[cell];
      parcel.shares[k] = held.shares[k][cell];
    }
    return parcel;
  }
  /// The content of a cell times a factor; the cell may have no free volume.
  Parcel<D> contentOf(const Index<D>& cell, double factor) const {
    Parcel<D> parcel;
    parcel.u[euler::kDensity] = factor * held.density[cell];
    for (int d = 0; d < D; ++d) parcel.u[euler::kVelocity(d)] = factor * held.momentum[cell][d];
    parcel.u[euler::kPressure<D>] = factor * held.totalEnergy[cell];
    for (std::size_t k = 0; k < held.shares.size(); ++k) {
      parcel.masses[k] = factor * held.masses[k][cell];
      parcel.shares[k] = held.shares[k][cell];
    }
    return parcel;
  }
  /// rho, v, p of the gas itself and, for K > 1 gases, the mass and the volume fraction of each.
  template <class G>
  euler::State<D, euler::kGases<G>> primitive(const G& gas, const Index<D>& cell) const {
    if constexpr (constexpr int K = euler::kGases<G>; K == 1) {
      return euler::primitive<D>(gas, conserved(cell));
    } else {
      const Parcel<D> own = parcel(cell);
      euler::State<D, K> u{};
      std::copy(own.u.begin(), own.u.end(), u.begin());
      for (int k = 0; k < K; ++k) {
        u[euler::kMass<D>(k)] = own.masses[k];
        u[euler::kShare<D, K>(k)] = own.shares[k];
      }
      return gas.blend ? gas.blend->template recover<D, K>(u) : euler::primitive<D>(gas, u);
    }
  }
};

/// Throws NumericalError for an impossible gas in a cell, given the free fraction `free` of the cell, the density of
/// the gas [kg/m³] and the last component of its primitive state.
template <int D>
[[noreturn]] void refuseGas(const Level& level, const euler::Gas& gas, const Index<D>& cell, double free,
                            double density, double last) {
  const Vec3 at = level.expandPoint<D>(level.cellCentre<D>(cell));
  throw NumericalError(fmt::format("the gas next to a body became unphysical: {:.6g} kg/m^3 and {:.6g} Pa in the free "
                                   "fraction {:.3g} of the cell at ({:g}, {:g}, {:g}) m",
                                   density, gas.pressureOf(density, last), free, at[0], at[1], at[2]),
                       "", "c.density", level.cellNumber<D>(cell));
}

/// Throws NumericalError for impossible contents of a cell that bodies fill: its mass [kg/m³] and internal energy
/// [J/m³], both per volume of the cell.
template <int D>
[[noreturn]] void refuseHole(const Level& level, const Index<D>& cell, double mass, double internal) {
  const Vec3 at = level.expandPoint<D>(level.cellCentre<D>(cell));
  throw NumericalError(
      fmt::format("the gas in a cell that bodies fill became unphysical: {:.6g} kg/m^3 with {:.6g} J/m^3 of internal "
                  "energy, per volume of the cell, at ({:g}, {:g}, {:g}) m",
                  mass, internal, at[0], at[1], at[2]),
      "", "c.density", level.cellNumber<D>(cell));
}

inline constexpr auto readsOld = [](const auto& label, int ghost) { return requiresOld(label, ghost); };
inline constexpr auto readsNew = [](const auto& label, int ghost) { return requiresNew(label, ghost); };

}  // namespace tushar::mpmice
