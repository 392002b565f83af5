#pragma once

#include <cmath>
#include <string_view>
#include <variant>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// What the shear modulus and the melting temperature depend on.
struct Compression {
  double pressure;     ///< Pa
  double ratio;        ///< density over that at the start, 1
  double temperature;  ///< K
};

/// The <shear_modulus> of the constitutive model.
struct ConstantShear {
  static constexpr std::string_view name = "constant_shear";
  static const input::Schema<ConstantShear>& schema() {
    static const input::Schema<ConstantShear> schema("shear_modulus_model", "The <shear_modulus>.");
    return schema;
  }
  double modulus(const Compression&, double initial) const { return initial; }
};

/// G = mu_0 (1 + A p/eta^(1/3) - B (T - 300 K)), eta = rho/rho_0: Steinberg, Cochran & Guinan, J. Appl. Phys. 51 (1980)
/// 1498, equation 1.
struct ScgShear {
  static constexpr std::string_view name = "scg_shear";
  double initial = 0;        ///< mu_0, Pa
  double byPressure = 0;     ///< A, 1/Pa
  double byTemperature = 0;  ///< B, 1/K

  static const input::Schema<ScgShear>& schema() {
    static const input::Schema<ScgShear> schema =
        input::Schema<ScgShear>("shear_modulus_model", "That of Steinberg, Cochran and Guinan.")
            .required("mu_0", &ScgShear::initial, "Pa", "at 300 K without pressure", input::positive())
            .required("A", &ScgShear::byPressure, "1/Pa", "its growth with the pressure", input::nonNegative())
            .required("B", &ScgShear::byTemperature, "1/K", "its fall with the temperature", input::nonNegative());
    return schema;
  }
  double modulus(const Compression& c, double) const {
    return initial * (1 + byPressure * c.pressure / std::cbrt(c.ratio) - byTemperature * (c.temperature - 300));
  }
};

using ShearModel = std::variant<ConstantShear, ScgShear>;

/// The <melt_temp> of the material.
struct ConstantMelting {
  static constexpr std::string_view name = "constant_Tm";
  static const input::Schema<ConstantMelting>& schema() {
    static const input::Schema<ConstantMelting> schema("melting_temp_model", "The <melt_temp> of the material.");
    return schema;
  }
  double temperature(const Compression&, double initial) const { return initial; }
};

/// T_m = T_m0 exp(2 a (1 - 1/eta)) eta^(2 (Gamma_0 - a - 1/3)): Steinberg, Cochran & Guinan, equation 5.
struct ScgMelting {
  static constexpr std::string_view name = "scg_Tm";
  double initial = 0;    ///< T_m0, K
  double gruneisen = 0;  ///< Gamma_0, 1
  double a = 0;          ///< 1

  static const input::Schema<ScgMelting>& schema() {
    static const input::Schema<ScgMelting> schema =
        input::Schema<ScgMelting>("melting_temp_model", "That of Steinberg, Cochran and Guinan.")
            .required("T_m0", &ScgMelting::initial, "K", "without pressure", input::positive())
            .required("Gamma_0", &ScgMelting::gruneisen, "1", "Grüneisen's constant", input::nonNegative())
            .required("a", &ScgMelting::a, "1", "fall of Grüneisen's constant with the density", input::nonNegative());
    return schema;
  }
  double temperature(const Compression& c, double) const {
    return initial * std::exp(2 * a * (1 - 1 / c.ratio)) * std::pow(c.ratio, 2 * (gruneisen - a - 1.0 / 3));
  }
};

using MeltingModel = std::variant<ConstantMelting, ScgMelting>;

}  // namespace tushar::mpm::solid
