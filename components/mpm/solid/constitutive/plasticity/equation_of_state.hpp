#pragma once

#include <cmath>
#include <string_view>
#include <variant>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// Arguments of an equation of state.
struct VolumeState {
  double oldMeanStress;       ///< mean stress at the start of the step [Pa], tension positive
  double dilatation;          ///< dilatation in the step, tr D dt [1]
  double volume;              ///< J at the end of the step [1]
  double temperature;         ///< temperature [K]
  double initialTemperature;  ///< initial temperature [K]
  double energy;              ///< energy gained since the start [J/kg]
  double bulkModulus;         ///< bulk modulus [Pa]
  double density;             ///< density rho_0 [kg/m^3]
  double specificHeat;        ///< specific heat [J/(kg K)]
};

/// Hypoelastic mean stress: p_new = p + K tr D dt, tension positive.
struct HypoelasticVolume {
  static constexpr std::string_view name = "default_hypo";

  static const input::Schema<HypoelasticVolume>& schema() {
    static const input::Schema<HypoelasticVolume> schema("equation_of_state", "The mean stress grows with K tr D.");
    return schema;
  }
  double meanStress(const VolumeState& s) const { return s.oldMeanStress + s.bulkModulus * s.dilatation; }
  /// Temperature change due to the volume change in the step [K].
  double heating(const VolumeState&) const { return 0; }
};

/// Hyperelastic mean stress: p = K/2 (J - 1/J), tension positive.
struct HyperelasticVolume {
  static constexpr std::string_view name = "default_hyper";

  static const input::Schema<HyperelasticVolume>& schema() {
    static const input::Schema<HyperelasticVolume> schema("equation_of_state", "The mean stress is K/2 (J - 1/J).");
    return schema;
  }
  double meanStress(const VolumeState& s) const { return s.bulkModulus / 2 * (s.volume - 1 / s.volume); }
  double heating(const VolumeState&) const { return 0; }
};

/// The pressure p = rho_0 C_0² eta (1 - Gamma_0 eta / 2) / (1 - S_alpha eta)² + Gamma_0 rho_0 c_v (T - T_0), eta = 1 -
/// J; Wilkins, Computer Simulation of Dynamic Phenomena (1999), chapter 3. The temperature changes by dT = -T Gamma_0 J
/// tr D dt. Since c_v (T - T_0) lacks the energy of cold compression, the velocity of a shock is U = C_0 + S_alpha u
/// only for weak shocks. Uintah has no such model today.
struct MieGruneisen {
  static constexpr std::string_view name = "mie_gruneisen_temperature";

  double soundSpeed = 0;  ///< speed of sound C_0 [m/s]
  double gruneisen = 0;   ///< Gamma_0 [1]
  double slope = 0;       ///< slope S_alpha [1]

  static const input::Schema<MieGruneisen>& schema() {
    static const input::Schema<MieGruneisen> schema =
        input::Schema<MieGruneisen>(
            "equation_of_state",
            "The Mie-Grüneisen equation of state, with the thermal energy taken from the temperature.")
            .required("C_0", &MieGruneisen::soundSpeed, "m/s", "speed of a weak shock", input::positive())
            .required("Gamma_0", &MieGruneisen::gruneisen, "1", "Grüneisen parameter", input::nonNegative())
            .required("S_alpha", &MieGruneisen::slope, "1",
                      "slope of the shock velocity as a function of the particle velocity", input::nonNegative());
    return schema;
  }
  double meanStress(const VolumeState& s) const {
    const double eta = 1 - s.volume, spread = 1 - slope * eta;
    const double cold = s.density * soundSpeed * soundSpeed * eta * (1 - 0.5 * gruneisen * eta) / (spread * spread);
    return -(cold + gruneisen * s.density * s.specificHeat * (s.temperature - s.initialTemperature));
  }
  double heating(const VolumeState& s) const { return -s.temperature * gruneisen * s.volume * s.dilatation; }
};

/// The pressure p = rho_0 C_0² eta (1 - Gamma_0 eta / 2) / (1 - S_alpha eta - S_2 eta² - S_3 eta³)² + Gamma_0 rho_0 e
/// in compression, rho_0 C_0² eta + Gamma_0 rho_0 e in tension, eta = 1 - J: Steinberg, UCRL-MA-106439 (1991). The
/// temperature changes by dT = -T Gamma_0 J tr D dt. Uintah's `mie_gruneisen`.
struct MieGruneisenEnergy {
  static constexpr std::string_view name = "mie_gruneisen";

  double soundSpeed = 0;          ///< speed of sound C_0 [m/s]
  double gruneisen = 0;           ///< Gamma_0 [1]
  double s1 = 0, s2 = 0, s3 = 0;  ///< s1, s2 and s3 [1]

  static const input::Schema<MieGruneisenEnergy>& schema() {
    using Self = MieGruneisenEnergy;
    static const input::Schema<Self> schema =
        input::Schema<Self>("equation_of_state",
                            "The Mie-Grüneisen equation of state, with the energy that a particle has gained.")
            .required("C_0", &Self::soundSpeed, "m/s", "speed of a weak shock", input::positive())
            .required("Gamma_0", &Self::gruneisen, "1", "Grüneisen parameter", input::nonNegative())
            .required("S_alpha", &Self::s1, "1",
                      "slope of the shock velocity as a function of the particle velocity, for a weak shock",
                      input::nonNegative())
            .value("S_2", &Self::s2, 0, "1", "second-order coefficient of the shock velocity")
            .value("S_3", &Self::s3, 0, "1", "third-order coefficient of the shock velocity");
    return schema;
  }
  double meanStress(const VolumeState& s) const {
    const double eta = 1 - s.volume;
    double pressure = s.density * soundSpeed * soundSpeed * eta;
    if (eta >= 0) {
      const double spread = 1 - eta * (s1 + eta * (s2 + eta * s3));
      pressure *= (1 - 0.5 * gruneisen * eta) / (spread * spread);
    }
    return -(pressure + gruneisen * s.density * s.energy);
  }
  double heating(const VolumeState& s) const { return -s.temperature * gruneisen * s.volume * s.dilatation; }
};

/// The equations of state; the first is the default, as in Uintah.
using EquationOfState = std::variant<HyperelasticVolume, HypoelasticVolume, MieGruneisen, MieGruneisenEnergy>;

}  // namespace tushar::mpm::solid
