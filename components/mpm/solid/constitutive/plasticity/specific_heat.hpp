#pragma once

#include <cmath>
#include <string_view>
#include <variant>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// Arguments of a model of the specific heat.
struct HeatState {
  double temperature;  ///< temperature [K]
  double ratio;        ///< ratio of the density to the initial density [1]
  double density;      ///< density [kg/m^3]
  double bulkModulus;  ///< bulk modulus [Pa]
};

/// A constant specific heat, <specific_heat> of the material.
struct ConstantHeat {
  static constexpr std::string_view name = "constant_Cp";
  static const input::Schema<ConstantHeat>& schema() {
    static const input::Schema<ConstantHeat> schema("specific_heat_model", "The <specific_heat> of the material.");
    return schema;
  }
  double specificHeat(const HeatState&, double constant) const { return constant; }
};

/// Specific heat A T³ - B T² + C T - D below a temperature, A_1 T + B_1 from there on: a fit to measurements of copper,
/// MacDonald & MacDonald, Phys. Rev. B 24 (1981) 1715.
struct CopperHeat {
  static constexpr std::string_view name = "copper_Cp";
  double transition = 270;  ///< temperature of the transition [K]
  /// A, B, C, D below the transition, from J/(kg K^4) to J/(kg K)
  double a0 = 0.0000416, b0 = 0.027, c0 = 6.21, d0 = 142.6;
  /// A_1 and B_1 above the transition, J/(kg K^2) and J/(kg K)
  double a1 = 0.1009, b1 = 358.4;

  static const input::Schema<CopperHeat>& schema() {
    using Self = CopperHeat;
    static const input::Schema<Self> schema =
        input::Schema<Self>(
            "specific_heat_model",
            "For copper: a cubic polynomial in T below a transition temperature, and a linear one above.")
            .value("T_transition", &Self::transition, 270, "K", "transition temperature", input::positive())
            .value("A_LowT", &Self::a0, 0.0000416, "J/(kg K^4)", "factor of T^3 below the transition")
            .value("B_LowT", &Self::b0, 0.027, "J/(kg K^3)", "factor of -T^2 below the transition")
            .value("C_LowT", &Self::c0, 6.21, "J/(kg K^2)", "factor of T below the transition")
            .value("D_LowT", &Self::d0, 142.6, "J/(kg K)", "constant subtracted below the transition")
            .value("A_HighT", &Self::a1, 0.1009, "J/(kg K^2)", "factor of T above the transition")
            .value("B_HighT", &Self::b1, 358.4, "J/(kg K)", "constant added above the transition");
    return schema;
  }
  double specificHeat(const HeatState& s, double) const {
    const double t = s.temperature;
    return t < transition ? ((a0 * t - b0) * t + c0) * t - d0 : a1 * t + b1;
  }
};

/// Specific heat A + B t + C |t|^-n on either side of the transition at T_c, t = T/T_c - 1: Lederman, Salamon &
/// Shacklette, Phys. Rev. B 9 (1974) 2981; the default constants are those of 4340 steel.
struct SteelHeat {
  static constexpr std::string_view name = "steel_Cp";
  double transition = 1040;                                ///< transition T_c [K]
  double a0 = 190.14, b0 = 273.75, c0 = 418.3, n0 = 0.2;   ///< A, B, C [J/(kg K)] and n [1] below the transition
  double a1 = 465.21, b1 = 267.52, c1 = 58.16, n1 = 0.35;  ///< the same constants above the transition

  static const input::Schema<SteelHeat>& schema() {
    using Self = SteelHeat;
    static const input::Schema<Self> schema =
        input::Schema<Self>("specific_heat_model",
                            "For steel: a formula with a peak at the transition temperature of iron.")
            .value("T_transition", &Self::transition, 1040, "K", "T_c, where t = T/T_c - 1 is 0", input::positive())
            .value("A_LowT", &Self::a0, 190.14, "J/(kg K)", "constant part below the transition")
            .value("B_LowT", &Self::b0, 273.75, "J/(kg K)", "factor of t below the transition")
            .value("C_LowT", &Self::c0, 418.3, "J/(kg K)", "factor of |t|^-n below the transition")
            .value("n_LowT", &Self::n0, 0.2, "1", "n below the transition")
            .value("A_HighT", &Self::a1, 465.21, "J/(kg K)", "constant part above the transition")
            .value("B_HighT", &Self::b1, 267.52, "J/(kg K)", "factor of t above the transition")
            .value("C_HighT", &Self::c1, 58.16, "J/(kg K)", "factor of |t|^-n above the transition")
            .value("n_HighT", &Self::n1, 0.35, "1", "n above the transition");
    return schema;
  }
  /// The specific heat; at T_c itself, it has its value one kelvin below T_c, as in Uintah.
  double specificHeat(const HeatState& s, double) const {
    const double away = s.temperature == transition ? -1 : s.temperature - transition;
    const double t = away / transition;
    return t < 0 ? a0 + b0 * t + c0 * std::pow(-t, -n0) : a1 + b1 * t + c1 * std::pow(t, -n1);
  }
};

/// The specific heat c = u³ / (c_0 + c_1 u + c_2 u² + c_3 u³) + beta² T K / rho, u = T/theta in K, theta = eta^a exp(b
/// (1 - 1/eta)), eta = rho/rho_0: theta is dimensionless, as in Uintah's code: the ratio of Debye's temperature to that
/// at rho_0. Sewell & Menikoff, Shock Compression of Condensed Matter (2003) 157, equations 5 to 7, and the difference
/// of c_p and c_v. (Uintah's exponent is b (eta - 1), which is the same at small compression.)
struct CubicHeat {
  static constexpr std::string_view name = "cubic_Cp";
  double a = 1, b = 1;                    ///< constants of Grüneisen's coefficient a + b/eta [1]
  double expansion = 0;                   ///< expansion beta [1/K]
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0;  ///< c_0 to c_3: kg K^4/J, kg K^3/J, kg K^2/J, kg K/J

  static const input::Schema<CubicHeat>& schema() {
    using Self = CubicHeat;
    static const input::Schema<Self> schema =
        input::Schema<Self>("specific_heat_model",
                            "A Debye law: proportional to T^3 at low temperatures, and saturating at high ones.")
            .value("a", &Self::a, 1, "1", "constant part of the Grüneisen parameter")
            .value("b", &Self::b, 1, "1", "part of the Grüneisen parameter that grows with the volume")
            .value("beta", &Self::expansion, 0, "1/K", "growth of the volume with the temperature")
            .required("c0", &Self::c0, "kg K^4/J",
                      "in c_v = u^3 / (c0 + c1 u + c2 u^2 + c3 u^3), u = T/theta (K), where theta is the Debye "
                      "temperature divided by its value at the initial density")
            .required("c1", &Self::c1, "kg K^3/J", "see c0")
            .required("c2", &Self::c2, "kg K^2/J", "see c0")
            .required("c3", &Self::c3, "kg K/J", "see c0");
    return schema;
  }
  double specificHeat(const HeatState& s, double) const {
    const double debye = std::pow(s.ratio, a) * std::exp(b * (1 - 1 / s.ratio)), u = s.temperature / debye;
    const double byVolume = u * u * u / (c0 + u * (c1 + u * (c2 + u * c3)));
    return byVolume + expansion * expansion * s.temperature * s.bulkModulus / s.density;
  }
};

using SpecificHeatModel = std::variant<ConstantHeat, CopperHeat, CubicHeat, SteelHeat>;

}  // namespace tushar::mpm::solid
