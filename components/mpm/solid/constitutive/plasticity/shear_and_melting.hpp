#pragma once

#include <cmath>
#include <string_view>
#include <variant>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// Arguments of shear and melting models.
struct Compression {
  double pressure;             ///< pressure [Pa]
  double ratio;                ///< ratio of the density to the initial density [1]
  double temperature;          ///< temperature [K]
  double density = 0;          ///< density [kg/m^3]
  double meltTemperature = 0;  ///< melting temperature [K]; only for the shear modulus
};

/// A constant shear modulus, <shear_modulus> of the constitutive model.
struct ConstantShear {
  static constexpr std::string_view name = "constant_shear";
  static const input::Schema<ConstantShear>& schema() {
    static const input::Schema<ConstantShear> schema("shear_modulus_model",
                                                     "The constant <shear_modulus> of the model.");
    return schema;
  }
  double modulus(const Compression&, double initial) const { return initial; }
};

/// The shear modulus G = mu_0 (1 + A p/eta^(1/3) - B (T - 300 K)), eta = rho/rho_0: Steinberg, Cochran & Guinan, J.
/// Appl. Phys. 51 (1980) 1498, equation 1.
struct ScgShear {
  static constexpr std::string_view name = "scg_shear";
  double initial = 0;        ///< initial value mu_0 [Pa]
  double byPressure = 0;     ///< pressure coefficient A [1/Pa]
  double byTemperature = 0;  ///< temperature coefficient B [1/K]

  static const input::Schema<ScgShear>& schema() {
    static const input::Schema<ScgShear> schema =
        input::Schema<ScgShear>("shear_modulus_model", "The Steinberg-Cochran-Guinan shear modulus.")
            .required("mu_0", &ScgShear::initial, "Pa", "shear modulus at 300 K without pressure", input::positive())
            .required("A", &ScgShear::byPressure, "1/Pa", "increase of the shear modulus with the pressure",
                      input::nonNegative())
            .required("B", &ScgShear::byTemperature, "1/K", "decrease of the shear modulus with the temperature",
                      input::nonNegative());
    return schema;
  }
  double modulus(const Compression& c, double) const {
    return initial * (1 + byPressure * c.pressure / std::cbrt(c.ratio) - byTemperature * (c.temperature - 300));
  }
};

/// The shear modulus G = mu_0 - D / (exp(T_0/T) - 1): Varshni, Phys. Rev. B 2 (1970) 3952.
struct MtsShear {
  static constexpr std::string_view name = "mts_shear";
  double initial = 0;      ///< initial value mu_0 [Pa]
  double fall = 0;         ///< coefficient D [Pa]
  double temperature = 0;  ///< temperature T_0 [K]

  static const input::Schema<MtsShear>& schema() {
    static const input::Schema<MtsShear> schema =
        input::Schema<MtsShear>("shear_modulus_model",
                                "Varshni's shear modulus, which belongs to the mechanical threshold stress.")
            .required("mu_0", &MtsShear::initial, "Pa", "shear modulus at 0 K", input::positive())
            .required("D", &MtsShear::fall, "Pa", "scale of the decrease with the temperature", input::nonNegative())
            .required("T_0", &MtsShear::temperature, "K", "temperature at which the shear modulus begins to decrease",
                      input::positive());
    return schema;
  }
  double modulus(const Compression& c, double) const {
    return initial - fall / std::expm1(temperature / c.temperature);
  }
};

/// The shear modulus G = ((mu_0 + mu' p/eta^(1/3)) (1 - t) + rho k T / (C m)) / (1 + exp((t - 1) / (zeta (1 - t / (1 +
/// zeta))))), t = T/T_m, eta = rho/rho_0, and 0 above t = 1 + zeta: Nadal & Le Poac, J. Appl. Phys. 93 (2003) 2472.
struct NpShear {
  static constexpr std::string_view name = "np_shear";
  double initial = 0;     ///< initial value mu_0 [Pa]
  double zeta = 0;        ///< zeta [1]
  double byPressure = 0;  ///< mu'/mu_0 [1/Pa]
  double lindemann = 0;   ///< Lindemann constant C [1]
  double atomicMass = 0;  ///< atomic mass m [u]

  static const input::Schema<NpShear>& schema() {
    static const input::Schema<NpShear> schema =
        input::Schema<NpShear>("shear_modulus_model", "The Nadal-Le Poac shear modulus, which falls to 0 at melting.")
            .required("mu_0", &NpShear::initial, "Pa", "shear modulus at 0 K without pressure", input::positive())
            .required("zeta", &NpShear::zeta, "1", "relative temperature range of the drop at melting",
                      input::positive())
            .required("slope_mu_p_over_mu0", &NpShear::byPressure, "1/Pa",
                      "increase of the shear modulus with the pressure")
            .required("C", &NpShear::lindemann, "1", "Lindemann's constant", input::positive())
            .required("m", &NpShear::atomicMass, "u", "mass of an atom", input::positive());
    return schema;
  }
  double modulus(const Compression& c, double) const {
    constexpr double boltzmannOverMassUnit = 1.380649e-23 / 1.66053906660e-27;
    const double t = c.temperature / c.meltTemperature, width = zeta * (1 - t / (1 + zeta));
    if (width <= 0) return 0;
    const double cold = initial * (1 + byPressure * c.pressure / std::cbrt(c.ratio)) * (1 - t);
    const double thermal = c.density * boltzmannOverMassUnit * c.temperature / (lindemann * atomicMass);
    return (cold + thermal) / (1 + std::exp((t - 1) / width));
  }
};

using ShearModel = std::variant<ConstantShear, MtsShear, NpShear, ScgShear>;

/// A constant melting temperature, <melt_temp> of the material.
struct ConstantMelting {
  static constexpr std::string_view name = "constant_Tm";
  static const input::Schema<ConstantMelting>& schema() {
    static const input::Schema<ConstantMelting> schema("melting_temp_model", "The <melt_temp> of the material.");
    return schema;
  }
  double temperature(const Compression&, double initial) const { return initial; }
};

/// The melting temperature T_m = T_m0 exp(2 a (1 - 1/eta)) eta^(2 (Gamma_0 - a - 1/3)): Steinberg, Cochran & Guinan,
/// equation 5.
struct ScgMelting {
  static constexpr std::string_view name = "scg_Tm";
  double initial = 0;    ///< initial value T_m0 [K]
  double gruneisen = 0;  ///< Gamma_0 [1]
  double a = 0;          ///< a [1]

  static const input::Schema<ScgMelting>& schema() {
    static const input::Schema<ScgMelting> schema =
        input::Schema<ScgMelting>("melting_temp_model", "The Steinberg-Cochran-Guinan melting temperature.")
            .required("T_m0", &ScgMelting::initial, "K", "melting temperature without pressure", input::positive())
            .required("Gamma_0", &ScgMelting::gruneisen, "1", "Grüneisen parameter", input::nonNegative())
            .required("a", &ScgMelting::a, "1", "decrease of the Grüneisen parameter with the density",
                      input::nonNegative());
    return schema;
  }
  double temperature(const Compression& c, double) const {
    return initial * std::exp(2 * a * (1 - 1 / c.ratio)) * std::pow(c.ratio, 2 * (gruneisen - a - 1.0 / 3));
  }
};

using MeltingModel = std::variant<ConstantMelting, ScgMelting>;

}  // namespace tushar::mpm::solid
