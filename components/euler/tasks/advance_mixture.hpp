#pragma once

#include "components/euler/blend.hpp"
#include "components/euler/boundary.hpp"
#include "components/euler/tasks/advance.hpp"

namespace tushar::euler {

/// Views of the variables of one of several gases that a step reads.
struct OldGas {
  CellView<const double> mass, share;

  static OldGas from(auto& take, int ghost) {
    return {.mass = take(requiresOld(c::gasMass, ghost)), .share = take(requiresOld(c::gasShare, ghost))};
  }
};
/// Views of the variables of one of several gases that a step computes.
struct NewGas {
  CellView<double> mass, share;

  static NewGas from(auto& take) { return {.mass = take(computes(c::gasMass)), .share = take(computes(c::gasShare))}; }
};

/// The law of the gases in a cell: `gases` contains their laws, `held` the volume fractions.
template <class Held, int D>
MixedGas mixedAt(const std::vector<Settings>& gases, const std::vector<Held>& held, const Index<D>& cell) {
  MixedGas mixed;
  for (std::size_t k = 0; k < gases.size(); ++k)
    mixed.add(held[k].share[cell], gases[k].gas.gamma, gases[k].gas.pInfinity);
  return mixed;
}

/// The masses of each gas in a cell; 0 for gases that do not exist.
template <class Held, int D>
std::array<double, kMostGases> massesIn(const std::vector<Held>& held, const Index<D>& cell) {
  std::array<double, kMostGases> masses{};
  for (std::size_t k = 0; k < held.size(); ++k) masses[k] = held[k].mass[cell];
  return masses;
}

/// The volume fractions of each gas in a cell; 0 for gases that do not exist.
template <class Held, int D>
std::array<double, kMostGases> sharesIn(const std::vector<Held>& held, const Index<D>& cell) {
  std::array<double, kMostGases> shares{};
  for (std::size_t k = 0; k < held.size(); ++k) shares[k] = held[k].share[cell];
  return shares;
}

/// The equilibrium of gases with laws of their own in a cell; `energy` is the internal energy per volume [J/m³].
template <class Held, int D>
Blend blendAt(const std::vector<Settings>& gases, const std::vector<Held>& held, double energy, const Index<D>& cell) {
  return gases.front().blend->at(massesIn(held, cell).data(), energy, sharesIn(held, cell).data());
}

/// The law of the gases in a cell, each of any law; `energy` is the internal energy per volume [J/m³].
template <class Held, int D>
MixedGas lawAt(const std::vector<Settings>& gases, const std::vector<Held>& held, double energy, const Index<D>& cell) {
  if (!gases.front().blend) return mixedAt(gases, held, cell);
  return blendAt(gases, held, energy, cell).law(energy);
}

/// The laws of K gases.
template <int K>
Mixture<K> mixtureOf(const std::vector<Settings>& gases) {
  Mixture<K> mixture;
  mixture.blend = gases.front().blend.get();
  if (mixture.blend) {  // states contain G and S themselves
    mixture.softness[0] = mixture.stiffness[1] = 1;
    return mixture;
  }
  for (int k = 0; k < K; ++k) {
    MixedGas pure;
    pure.add(1, gases[k].gas.gamma, gases[k].gas.pInfinity);
    mixture.softness[k] = pure.softness;
    mixture.stiffness[k] = pure.stiffness;
  }
  return mixture;
}

/// Throws NumericalError for the first cell of the patch with an impossible state, if there is one. `held` contains the
/// volume fractions of each gas.
template <int D, class Held, class T>
void refuseBrokenMixture(const Patch& patch, const std::vector<Settings>& gases, const std::vector<Held>& held,
                         const StateViews<D, T>& state);

/// Like ghostRules, but with the laws of several gases; the conditions are those of `first`, without its law: a
/// pressure that is given is that of all gases, also if that of the first one depends on its density alone. For a
/// single gas, `gases` is empty.
template <int D>
GhostRules<D> ghostRulesOf(const Level& level, const Gas& first, const std::vector<Settings>& gases, double time,
                           const Box& cells) {
  if (gases.empty()) return ghostRules<D>(level, first, time, cells);
  Gas shared = first;
  shared.law = nullptr;
  GhostRules<D> rules = ghostRules<D>(level, shared, time, cells);
  return gases.size() == 2 ? withLaws<D>(std::move(rules), mixtureOf<2>(gases))
                           : withLaws<D>(std::move(rules), mixtureOf<3>(gases));
}
template <int D>
GhostRules<D> ghostRulesOf(const Level& level, const Gas& first, const std::vector<Settings>& gases, double time = 0) {
  return ghostRulesOf<D>(level, first, gases, time, level.cells().grown(1, D));
}

/// The views of the joint state of all gases, and of the state of each.
template <class T, int D, class Held>
MixtureViews<D, T> viewsOf(const StateViews<D, T>& all, const std::vector<Held>& held) {
  MixtureViews<D, T> views{all, {}, {}};
  for (const Held& one : held) {
    views.masses.push_back(one.mass);
    views.shares.push_back(one.share);
  }
  return views;
}

/// One step of several gases. It is that of Advance for their mixture, but with limited slopes of the mass and the
/// volume fraction of each gas instead of the density. Faces advect volume fractions with the velocity of the contact,
/// so that uniform velocity and pressure remain uniform. The limited fractions of three gases at a face need not add up
/// to 1. They are scaled until they do, at constant densities of the gases. Sources: G. Allaire, S. Clerc & S. Kokh, J.
/// Comput. Phys. 181 (2002) 577; for volume fractions with HLLC, E. Johnsen & T. Colonius, J. Comput. Phys. 219 (2006)
/// 715.
template <int D>
using AdvanceMixture = void (*)(const Patch& patch, const std::vector<Settings>& gases, const OldState<D>& old,
                                const std::vector<OldGas>& oldGases, double time, double dt, const NewState<D>& fresh,
                                const std::vector<NewGas>& newGases, const RimFluxes<D>& rims,
                                const std::vector<GasRims>& gasRims);

/// The body of the task for a method and a number of gases, with the HLLC flux and van Leer's slopes or none.
template <int D>
AdvanceMixture<D> chooseAdvanceMixture(const Method& method, std::size_t gases);

/// Divides volume fractions by their sum in the cells where it is no longer 1 because fluxes through the rim of a level
/// were corrected. The sum contains the correction of the flux of volume. Other cells are unchanged.
template <int D>
void closeShares(const Patch& patch, const std::vector<Settings>& gases, const std::vector<CellView<double>>& shares);
/// The same for cells beside finer ones.
template <int D>
void closeRefluxed(const Patch& patch, const std::vector<Settings>& gases, const std::vector<Box>& besideFiner,
                   const std::vector<CellView<double>>& shares);

/// Sets the volume fractions of gases with laws of their own to those in equilibrium. Throws NumericalError for the
/// first cell with an impossible state, if there is one.
template <int D>
void closeBlend(const Patch& patch, const std::vector<Settings>& gases, CellView<const double> density,
                CellView<const Vec<D>> momentum, CellView<const double> totalEnergy,
                const std::vector<CellView<const double>>& masses, const std::vector<CellView<double>>& shares);
/// Throws NumericalError for a cell whose gases, with laws of their own, have no equilibrium, given the mass [kg/m³]
/// of each and the internal energy [J/m³] of all, per volume of the gas.
template <int D>
[[noreturn]] void refuseBlend(const BlendLaws& laws, const Level& level, const Index<D>& cell,
                              const std::array<double, kMostGases>& masses, double energy);

/// Views of the variables of one of several gases that regridding changes.
struct ChangedGas {
  CellView<double> mass, share;

  static ChangedGas from(auto& take) {
    return {.mass = take(modifies(c::gasMass)), .share = take(modifies(c::gasShare))};
  }
};
/// Replaces impossible new cells of several gases, like mendNewCells. Since the values of new cells are interpolated
/// separately, it first sets the density to the sum of the masses, and scales the volume fractions so that they add up
/// to 1. If the result is not a possible state, all children of the parent cell get their mean.
template <int D>
void mendNewMixture(const Patch& patch, const std::vector<Settings>& gases, const std::vector<Box>& newCells,
                    const ChangedState<D>& state, const std::vector<ChangedGas>& held);

/// Throws NumericalError if refluxing has made the state of a cell beside finer cells impossible. For gases with laws
/// of their own, sets the volume fractions there to those in equilibrium.
template <int D>
void checkRefluxedMixture(const Patch& patch, const std::vector<Settings>& gases, const std::vector<Box>& besideFiner,
                          const ChangedState<D>& state, const std::vector<ChangedGas>& held);

/// Computes dt like computeStableTimeStep, with rho c² = (p (1 + G) + S) / G.
/// Throws NumericalError where a state is impossible.
template <int D>
void limitMixtureStep(const Patch& patch, const std::vector<Settings>& gases, const Courant& courant,
                      const OldState<D>& old, const std::vector<OldGas>& held, Minimum& dt);

}  // namespace tushar::euler
