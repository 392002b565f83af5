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

 protected:
  /// Burn rate m [kg/(m² s)] of a surface with the temperature `surface` [K].
  double rateAt(double surface, const AtSurface& at) const {
    const double heating = surface - at.bodyTemperature - 0.5 * solidHeat / specificHeat;
    return std::sqrt(reactionAt(surface, at.bodyDensity) / (activationEnergy * specificHeat * heating));
  }
  /// A R k_c rho T_s² exp(-E / (R T_s)), given T_s [K] and rho [kg/m³].
  double reactionAt(double surface, double density) const {
    return solidFactor * gasConstant * solidConductivity * density * surface * surface *
           std::exp(-activationEnergy / (gasConstant * surface));
  }
};

/// What a burning surface remembers: its temperature T_s [K], and the temperature gradient below it, beta [K/m]. The
/// gradient is 0 where nothing burns.
struct SurfaceHeat {
  double temperature = 0, gradient = 0;

  bool burns() const { return gradient > 0; }
};

/// The unsteady deflagration of a solid: the reactions are as fast as in SteadyBurn, but T_s and the gradient beta
/// below the surface follow those of the steady deflagration with delays. With the steady m,
///
///   dbeta/dt = (beta_steady - beta) / tau,     beta_steady = m c (T_s,steady - T_0) / k_c,  tau = N_c k_c rho / (c m²)
///   dT_s/dt = (T_s,steady - T_s) / (N_g tau).
///
/// The rate is the smaller root of Q_c m² / 2 - k_c beta m + A R k_c rho T_s² exp(-E / (R T_s)) / E = 0, which is the
/// first equation of SteadyBurn with k_c beta in place of m c (T_s - T_0). Then it is scaled to m (rate / m)^B.
///
/// Source: the theory of Zel'dovich and Novozhilov, as in S. F. Son & M. Q. Brewster, J. Propul. Power 9 (1993) 222;
/// the delays and B are those of Uintah's Unsteady_Burn.
struct UnsteadyBurn : SteadyBurn {
  double solidDelay = 0;  ///< N_c [1]
  double gasDelay = 0;    ///< N_g [1]
  double exponent = 1;    ///< B [1]

  /// The state that a surface has in a steady deflagration.
  SurfaceHeat steady(const AtSurface& at) const {
    const double surface = surfaceTemperature(at);
    return {surface, rateAt(surface, at) * specificHeat * (surface - at.bodyTemperature) / solidConductivity};
  }
  /// The state after the time dt [s], during which the conditions are constant. A surface that did not burn begins with
  /// the steady state.
  SurfaceHeat after(const SurfaceHeat& before, double dt, const AtSurface& at) const {
    SurfaceHeat state = steady(at);
    if (!before.burns()) return state;
    const double m = rateAt(state.temperature, at);
    const double delay = solidDelay * solidConductivity * at.bodyDensity / (specificHeat * m * m);
    state.gradient += (before.gradient - state.gradient) * std::exp(-dt / delay);
    state.temperature += (before.temperature - state.temperature) * std::exp(-dt / (gasDelay * delay));
    return state;
  }
  /// The burn rate [kg/(m² s)] in a state; none if beta is too small for T_s, so that the equation has no root.
  std::optional<double> rateIn(const SurfaceHeat& state, const AtSurface& at) const {
    const double flow = solidConductivity * state.gradient;
    const double reaction = reactionAt(state.temperature, at.bodyDensity) / activationEnergy;
    const double square = flow * flow - 2 * solidHeat * reaction;
    if (!(square >= 0)) return {};
    const double unscaled = 2 * reaction / (flow + std::sqrt(square));
    if (exponent == 1) return unscaled;
    const double m = rate(at);
    return m * std::pow(unscaled / m, exponent);
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
  std::variant<SimpleBurn, SteadyBurn, UnsteadyBurn, Decay, Ddt> law;

  /// The model of deflagration in cracks; null for other models.
  const Ddt* ddt() const { return std::get_if<Ddt>(&law); }
  /// The model whose surfaces have a state; null for other models.
  const UnsteadyBurn* unsteady() const { return std::get_if<UnsteadyBurn>(&law); }
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

/// The tag `<Unsteady_Burn>`.
struct UnsteadyBurnSection : UnsteadyBurn {
  Location where;
  std::string from, to;
  double ignitionTemperature = 0, thresholdPressure = 0;

  BurnModel model() const {
    return {where, from, to, ignitionTemperature, thresholdPressure, solidHeat + gasHeat, UnsteadyBurn(*this)};
  }
};
const input::Schema<UnsteadyBurnSection>& unsteadyBurnSchema();

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
