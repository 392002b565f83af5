#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/euler/mixture.hpp"

// Gases that share cells if one of them has its own law: they have one pressure, one temperature and one velocity in
// each cell. Such a law is not linear in the volume fractions, and the pressure of some depends on the density alone;
// so volume fractions are not advected, but follow from the masses and the energy of the cell.
//
// During a step, the gas of a cell is treated as the stiffened gas that has the same energy, pressure and speed of
// sound, e = p G + S and rho c² = (p (1 + G) + S) / G, whose G and S move with the flow. Source, for this idea: K.-M.
// Shyue, J. Comput. Phys. 171 (2001) 678.

namespace tushar::euler {

/// The equilibrium of the gases in a cell.
struct Blend {
  double pressure = 0;                      ///< p [Pa]
  double temperature = 0;                   ///< T [K]
  double modulus = 0;                       ///< rho c² [Pa] of gases that stay in equilibrium
  std::array<double, kMostGases> shares{};  ///< volume fractions, which add up to 1
  bool isPossible = false;                  ///< whether there is such a state, with a positive temperature

  /// The stiffened gas that is equivalent for small changes, given the internal energy per volume [J/m³]. Its
  /// parameters are NaN if the state is impossible.
  MixedGas law(double energy) const;
};

/// The laws of gases that share cells.
class BlendLaws {
 public:
  /// `gases` are ideal or stiffened gases, or have a law of type CurvedGas, Water or, without attraction, RealGas. All
  /// have a specific heat.
  explicit BlendLaws(const std::vector<Gas>& gases);

  std::size_t size() const { return substances_.size(); }

  /// The equilibrium in a cell, given the mass of each gas per volume of the cell [kg/m³] and the internal energy per
  /// volume [J/m³]: p and T with sum of m_k / rho_k(p, T) = 1 and sum of m_k e_k = e, by Newton's method to round-off.
  /// A liquid that does not fill the cell alone has almost no pressure. A mass below 0, which round-off of fluxes may
  /// leave, counts as 0. If there are `shares`, the volume fractions of a state nearby, Newton's method begins with
  /// them; with those of the equilibrium itself, it takes one step.
  Blend at(const double* masses, double energy, const double* shares = nullptr) const;

  /// Sets p and, in place of the volume fractions, G and S in a state that contains the density, the masses, and the
  /// total energy; sets velocities in place of the momenta.
  template <int D, int K>
  State<D, K> recover(const State<D, K>& u) const {
    State<D, K> w = u;
    const double inverse = 1 / u[kDensity];
    for (int k = 0; k < D; ++k) w[kVelocity(k)] = u[kVelocity(k)] * inverse;
    const double energy = u[kPressure<D>] - 0.5 * u[kDensity] * speedSquared<D>(w);
    const Blend blend = at(&u[kMass<D>(0)], energy, &u[kShare<D, K>(0)]);
    const MixedGas law = blend.law(energy);
    w[kPressure<D>] = blend.pressure;
    for (int k = 0; k < K; ++k) w[kShare<D, K>(k)] = k == 0 ? law.softness : k == 1 ? law.stiffness : 0;
    return w;
  }

  /// Up to which temperatures the laws are valid, for messages; empty if this is not limited.
  std::string limits() const;

 private:
  /// A gas with p = p_cold(rho) + h(rho) c_v T and e = E_cold(rho) / rho + c_v T, where h = Gamma rho / (1 - b rho); or
  /// water.
  struct Substance {
    double specificHeat = 0;  ///< c_v [J/(kg K)]
    double gruneisen = 0;     ///< Gamma
    double pInfinity = 0;     ///< p_inf [Pa] of a stiffened gas
    double covolume = 0;      ///< b [m³/kg] of hard spheres
    const CurvedGas* law = nullptr;
    const Water* water = nullptr;

    bool isLinear() const { return law && law->cold().kind == ColdCurve::Kind::linear; }
    double coldPressure(double rho) const { return law ? law->cold().pressure(rho) : -pInfinity; }
    double coldEnergy(double rho) const { return law ? law->cold().energy(rho) / rho : pInfinity / rho; }
    /// The energy [J/kg] that it has lost at 0 K where its energy is 0.
    double heatBelow() const { return water ? water->heatBelow() : 0; }
    /// The density [kg/m³] at a given pressure [Pa] and temperature [K]; Newton's method begins at `guess`.
    double densityAt(double pressure, double temperature, double guess) const;
    /// The pressure [Pa] at a given density [kg/m³] and temperature [K]; not of water.
    double pressureAt(double rho, double temperature) const;
    /// dp/drho at constant temperature [m²/s²], given the cold pressure; not of water.
    double stiffnessAt(double rho, double cold, double temperature) const;
  };
  struct Sums;
  /// Where Newton's method begins.
  struct Guess {
    double pressure, temperature;
    std::array<double, kMostGases> rho{};  ///< the density of each gas [kg/m³]
  };

  /// The state with given volume fractions and energy: its temperature, and the pressure of the softest gas. None if it
  /// is impossible, or for water.
  std::optional<Guess> guessFrom(const double* masses, double energy, const double* shares) const;
  Sums sumsAt(const double* masses, double pressure, double temperature, std::array<double, kMostGases>& rho) const;
  /// The temperature at which the gases have a given energy at a given pressure.
  double temperatureAt(const double* masses, double energy, double pressure, std::array<double, kMostGases>& rho) const;
  /// Finds p and T by bisection, where Newton's method fails.
  void bisect(const double* masses, double energy, double& pressure, double& temperature,
              std::array<double, kMostGases>& rho) const;

  std::vector<Gas> gases_;
  std::vector<Substance> substances_;
};

}  // namespace tushar::euler
