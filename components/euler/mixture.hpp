#pragma once

#include "components/euler/gas.hpp"

// Several gases in a cell at one pressure and one velocity, each in its part of the volume: the five-equation model of
// G. Allaire, S. Clerc & S. Kokh, J. Comput. Phys. 181 (2002) 577. The mass of each gas, the momentum and the total
// energy are conserved; the volume fractions z_k move with the flow, dz_k/dt + v . grad z_k = 0.

namespace tushar::euler {

/// Stiffened gases that share a cell. Their energy per volume is p G + S, where G = sum of z_k / (gamma_k - 1) and S =
/// sum of z_k gamma_k p_inf,k / (gamma_k - 1). G and S are linear in the volume fractions, so the pressure stays
/// uniform across a contact.
struct MixedGas {
  double softness = 0;   ///< G
  double stiffness = 0;  ///< stiffness S [J/m³]

  /// Adds a gas with its volume fraction.
  void add(double share, double gamma, double pInfinity) {
    softness += share / (gamma - 1);
    stiffness += share * gamma * pInfinity / (gamma - 1);
  }
  /// Squared speed of sound c² [m²/s²], from rho c² = (p (1 + G) + S) / G.
  double soundSpeedSquared(double density, double pressure) const {
    return (pressure * (1 + softness) + stiffness) / (softness * density);
  }
  /// Internal energy per volume [J/m³].
  double energyOf(double, double pressure) const { return pressure * softness + stiffness; }
  /// Pressure [Pa] at an internal energy per volume [J/m³].
  double pressure(double, double internalEnergyPerVolume) const {
    return (internalEnergyPerVolume - stiffness) / softness;
  }
  double last(double density, double internalEnergyPerVolume) const {
    return pressure(density, internalEnergyPerVolume);
  }
  static double pressureOf(double, double pressure) { return pressure; }
  /// p + p_inf [Pa] of the stiffened gas with the same G and S; it is greater than 0 in possible states.
  double heat(double, double pressure) const { return pressure + leastPressure(); }
  double leastPressure() const { return stiffness / (1 + softness); }
  /// (gamma + 1) / 2 of the equivalent stiffened gas.
  double shockSlope() const { return 1 + 0.5 / softness; }
  /// The equivalent stiffened gas; its parameters are NaN for impossible volume fractions.
  Gas alike() const {
    Gas gas;
    gas.gamma = softness > 0 ? 1 + 1 / softness : std::nan("");
    gas.pInfinity = softness > 0 ? leastPressure() : std::nan("");
    return gas;
  }
};

/// The largest number of gases.
inline constexpr int kMostGases = 3;

class BlendLaws;

/// The laws of K gases that share cells. If one of them has its own law, `blend` has the laws; states then contain G
/// and S of their cells in place of the first two volume fractions, and 0 in place of the third (see blend.hpp).
template <int K>
struct Mixture {
  std::array<double, K> softness{}, stiffness{};
  const BlendLaws* blend = nullptr;
};
template <int K>
inline constexpr int kGases<Mixture<K>> = K;

/// The law that applies in a state, from the volume fractions that the state contains.
template <int D, int K>
MixedGas lawIn(const Mixture<K>& gases, const State<D, K>& w) {
  MixedGas mixed;
  for (int k = 0; k < K; ++k) {
    mixed.softness += w[kShare<D, K>(k)] * gases.softness[k];
    mixed.stiffness += w[kShare<D, K>(k)] * gases.stiffness[k];
  }
  return mixed;
}

}  // namespace tushar::euler
