#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include "core/input/diagnostics.hpp"
#include "core/input/schema.hpp"

namespace tushar::ice {

/// The conditions at a surface that determine how it burns.
struct AtSurface {
  double pressure = 0;         ///< pressure of the gas at the surface [Pa]
  double bodyTemperature = 0;  ///< temperature of the body below its surface [K]
  double bodyDensity = 0;      ///< density of the body [kg/m³]
};

/// A burn rate that depends only on the pressure, as in Uintah's Simple_Burn.
struct SimpleBurn {
  double coefficient = 0;        ///< burn rate at the reference pressure [kg/(m² s)]
  double referencePressure = 0;  ///< reference pressure [Pa]

  /// The burn rate [kg/(m² s)].
  double rate(const AtSurface& at) const {
    constexpr double exponent = 0.778;  // of Uintah's model, for the explosive PBX 9501
    return coefficient * std::pow(at.pressure / referencePressure, exponent);
  }
};

/// The steady deflagration of a solid, with one reaction in the solid and another one in the gas close to it. The
/// surface temperature T_s and the burn rate m satisfy
///
///   m² = A R k_c rho T_s² exp(-E / (R T_s)) / (E c (T_s - T_0 - Q_c / (2 c)))
///   T_s = T_0 + Q_c / c + Q_g / c / (1 + x m c / k_g),   x = 2 k_g / (c (sqrt(m² + 4 k_g B (W p)² / (c R²)) - m)).
///
/// Source: M. J. Ward, S. F. Son and M. Q. Brewster, Combust. Flame 114 (1998) 556.
struct SteadyBurn {
  double gasConstant = 0;        ///< gas constant R [J/(mol K)]
  double solidFactor = 0;        ///< pre-exponential factor A of the reaction in the solid [1/s]
  double activationEnergy = 0;   ///< activation energy E [J/mol]
  double gasFactor = 0;          ///< rate factor B of the reaction in the gas [m³/(kg s K²)]
  double solidHeat = 0;          ///< heat of the reaction in the solid, Q_c [J/kg]
  double gasHeat = 0;            ///< heat of the reaction in the gas, Q_g [J/kg]
  double gasConductivity = 0;    ///< gas conductivity k_g [W/(m K)]
  double solidConductivity = 0;  ///< solid conductivity k_c [W/(m K)]
  double specificHeat = 0;       ///< specific heat c of solid and gas [J/(kg K)]
  double molarMass = 0;          ///< molar mass W [kg/mol]

  /// The burn rate [kg/(m² s)].
  double rate(const AtSurface& at) const { return rateAt(surfaceTemperature(at), at); }
  /// Surface temperature T_s [K], by bisection to round-off.
  double surfaceTemperature(const AtSurface& at) const {
    const double rise = gasHeat / specificHeat;
    double least = at.bodyTemperature + solidHeat / specificHeat, most = least + rise;
    const double start = least;
    const double wp = molarMass * at.pressure / gasConstant;
    const double far = 4 * gasConductivity * gasFactor * wp * wp / specificHeat;
    const auto isTooLow = [&](double temperature) {
      const double m = rateAt(temperature, at), both = std::sqrt(m * m + far) + m;
      return temperature < start + rise * far / (both * both);
    };
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (least + most);
      if (middle <= least || middle >= most) break;
      (isTooLow(middle) ? least : most) = middle;
    }
    return most;
  }

 private:
  /// Burn rate m [kg/(m² s)] of a surface with the temperature `surface` [K].
  double rateAt(double surface, const AtSurface& at) const {
    const double reaction = solidFactor * gasConstant * solidConductivity * at.bodyDensity * surface * surface *
                            std::exp(-activationEnergy / (gasConstant * surface));
    const double heating = surface - at.bodyTemperature - 0.5 * solidHeat / specificHeat;
    return std::sqrt(reaction / (activationEnergy * specificHeat * heating));
  }
};

/// `<Model type="Test">` of a body: a fraction of the remaining body per unit time is converted into gas, everywhere.
struct Decay {
  double perTime = 0;    ///< fraction per unit time [1/s]
  double startTime = 0;  ///< start time [s]
};

/// The time that a flame takes to cross a cell of explosive. Along a surface, a flame spreads with the speed F_b (p /
/// p_0)^F_c; into the body, it is faster by the factor 1 / I_c. Source: S. F. Son, B. W. Asay, E. M. Whitney & H. L.
/// Berghout, Proc. Combust. Inst. 31 (2007) 2063; the dependence on the angle is that of Uintah's DDT1.
struct Induction {
  double inwards = 1;   ///< I_c [1]
  double pressure = 0;  ///< pressure p_0 [Pa]
  double speed = 0;     ///< speed F_b [m/s]
  double exponent = 0;  ///< F_c [1]

  /// The time that a flame takes along a path, relative to that along a surface; it is between I_c and 1. `cosine`
  /// belongs to the angle between the path of the flame and the normal of the surface.
  double part(double cosine) const {
    const double along = 1 - 2 * cosine * cosine;  // sin(2 theta - pi/2)
    return 0.5 * (1 + inwards) + 0.5 * (1 - inwards) * along;
  }
  /// The time [s] that a flame takes to cover a width [m] along a surface at the pressure `at` [Pa].
  double time(double width, double at) const { return width / (speed * std::pow(at / pressure, exponent)); }
};

/// The deflagration of Uintah's DDT1, at surfaces and in cracks; a detonation ends the run. Source: J. R. Peterson & C.
/// A. Wight, Combust. Flame 159 (2012) 2491.
struct Ddt {
  SteadyBurn surface;
  double detonationPressure = 0;  ///< pressure above which the body detonates [Pa]
  bool burnsCracks = false;
  std::optional<Induction> induction;

  double rate(const AtSurface& at) const { return surface.rate(at); }
  /// Whether gas at a pressure [Pa] burns in cracks with a radius [m]: p^2.84 w^2 > 8e8. Source: H. L. Berghout, S. F.
  /// Son, C. B. Skidmore, D. J. Idar & B. W. Asay, Thermochim. Acta 384 (2002) 261, after Belyaev.
  static bool enterCracks(double pressure, double radius) {
    return pressure > 0 && std::pow(pressure, 2.84) * radius * radius > 8e8;
  }
  /// The surface area of cracks per volume of the body [1/m], as in Uintah: that of plates 2 mm thick, each with one
  /// burning face.
  static constexpr double surfaceOfCracks = 500;
};

/// A body that is converted into a gas, and the law by which it burns.
struct BurnModel {
  Location where;                  ///< in the scene
  std::string from, to;            ///< names of the two materials
  double ignitionTemperature = 0;  ///< ignition temperature [K]
  double leastPressure = 0;        ///< pressure below which nothing burns [Pa]
  double heat = 0;                 ///< heat of the reaction [J/kg]
  std::variant<SimpleBurn, SteadyBurn, Decay, Ddt> law;

  /// The model of deflagration in cracks; null for other models.
  const Ddt* ddt() const { return std::get_if<Ddt>(&law); }
  /// Whether only surfaces burn, rather than the whole body.
  bool burnsAtSurface() const { return !std::holds_alternative<Decay>(law); }
  /// Burn rate of a surface [kg/(m² s)].
  double rate(const AtSurface& at) const {
    return std::visit(
        [&](const auto& model) {
          if constexpr (requires { model.rate(at); })
            return model.rate(at);
          else
            return 0.0;
        },
        law);
  }
};

/// The tag `<Simple_Burn>`.
struct SimpleBurnSection {
  Location where;
  bool isActive = true;
  std::string from, to;
  double thresholdTemperature = 0, thresholdPressure = 0, enthalpy = 0, coefficient = 0, reference = 0;

  BurnModel model() const {
    return {where, from, to, thresholdTemperature, thresholdPressure, enthalpy, SimpleBurn{coefficient, reference}};
  }
};
const input::Schema<SimpleBurnSection>& simpleBurnSchema();

/// The tag `<Steady_Burn>`.
struct SteadyBurnSection : SteadyBurn {
  Location where;
  std::string from, to;
  double ignitionTemperature = 0, thresholdPressure = 0;

  BurnModel model() const {
    return {where, from, to, ignitionTemperature, thresholdPressure, solidHeat + gasHeat, SteadyBurn(*this)};
  }
};
const input::Schema<SteadyBurnSection>& steadyBurnSchema();

/// The tag `<DDT1>`.
struct DdtSection : SteadyBurn, Induction {
  Location where;
  std::string from, to, burnt;
  double ignitionTemperature = 0, thresholdPressure = 0, detonationPressure = 0;
  bool burnsCracks = false, waits = false;

  BurnModel model() const {
    Ddt law{SteadyBurn(*this), detonationPressure, burnsCracks, {}};
    if (waits) law.induction = Induction(*this);
    return {where, from, to, ignitionTemperature, thresholdPressure, solidHeat + gasHeat, law};
  }
};
const input::Schema<DdtSection>& ddtSchema();

}  // namespace tushar::ice
