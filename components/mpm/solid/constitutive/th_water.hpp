#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// Water with its greatest density near 4 °C, without viscosity: v = v_0 (1 - k p + L (T - T_0 + a p)²), with the heat
/// capacity c_p = c_0 + b (T_0 - T) - 2 v_0 L T p, whose last term follows from v; Thomsen & Hartka, Am. J. Phys. 30
/// (1962) 26. Compression heats along the adiabat, dT = -T (dp/dT)_v dv/c_v; Uintah turns the work -p dv into heat
/// instead.
struct ThWater {
  struct State {};
  using Capabilities = CapabilityList<capability::ConstantsOfMaterial, capability::TemperatureChange>;
  static constexpr std::string_view name = "TH_water";
  static constexpr bool strainEnergyIsRate = true;

  MaterialConstants material;
  double pressureShift = 0;           ///< a, decrease of T_0 with the pressure [K/Pa]
  double heatSlope = 0;               ///< b, decrease of c_p with the temperature [J/(kg K²)]
  double specificHeat = 0;            ///< specific heat c_0 at T_0 and p = 0 [J/(kg K)]
  double compressibility = 0;         ///< compressibility k [1/Pa]
  double densestTemperature = 0;      ///< temperature T_0 of largest density at p = 0 [K]
  double curvature = 0;               ///< curvature L of the volume around T_0 [1/K²]
  double densestVolume = 0;           ///< specific volume v_0 at T_0 and p = 0 [m^3/kg]
  double referencePressure = 101325;  ///< pressure at which the stress is 0 [Pa]

  static const input::Schema<ThWater>& schema() {
    using Self = ThWater;
    static const input::Schema<Self> schema =
        input::Schema<Self>("TH_water", "Water of Thomsen & Hartka, without viscosity.")
            .required("a", &Self::pressureShift, "K/Pa",
                      "rate at which the temperature of largest density decreases with pressure", input::positive())
            .required("b", &Self::heatSlope, "J/(kg K²)", "rate at which the heat capacity falls with temperature")
            .required("co", &Self::specificHeat, "J/(kg K)", "heat capacity at <To> without pressure",
                      input::positive())
            .required("ko", &Self::compressibility, "1/Pa", "compressibility at <To> without pressure",
                      input::positive())
            .required("To", &Self::densestTemperature, "K", "temperature of largest density, without pressure",
                      input::positive())
            .required("L", &Self::curvature, "1/K²", "curvature of the volume around <To>", input::positive())
            .required("vo", &Self::densestVolume, "m^3/kg", "specific volume at <To> without pressure",
                      input::positive())
            .value("Pref", &Self::referencePressure, 101325, "Pa", "ambient pressure");
    return schema;
  }
  State initialState() const { return {}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    return (referencePressure - pointAt(d).pressure) * Matrix3::Identity();
  }
  /// The wave speed: c² = -v² (dp/dv)_s = v² (c_v (dp/dv)_T + T (dp/dT)_v²)/c_v.
  double waveSpeed(double, const Deformation& d, const Matrix3&, const State&) const {
    const Point at = pointAt(d);
    const double steepness = at.byTemperature / at.byPressure;
    return at.volume * std::sqrt(1 / at.byPressure + at.temperature * steepness * steepness / heatAtConstantVolume(at));
  }
  double temperatureChange(const Deformation& d, const Matrix3&, const State&) const {
    const Point at = pointAt(d);
    const double growth = 1 - d.oldDeformationGradient.determinant() / d.deformationGradient.determinant();
    const double steepness = at.byTemperature / at.byPressure;  // (dp/dT)_v, Pa/K
    return -at.temperature * steepness * at.volume * growth / heatAtConstantVolume(at);
  }
  /// Returns 0 as in Uintah, so that StrainEnergy can be compared.
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }

 private:
  struct Point {
    double volume;         ///< volume v [m^3/kg]
    double temperature;    ///< temperature T [K]
    double pressure;       ///< pressure p [Pa]
    double byPressure;     ///< -(dv/dp)_T [m^3/(kg Pa)]
    double byTemperature;  ///< (dv/dT)_p [m^3/(kg K)]
    double heat;           ///< heat capacity c_p [J/(kg K)]
  };
  /// Lower limit of c_v, as a fraction of c_p = c_v + T (dp/dT)_v (dv/dT)_p, and of the compressibility, as a fraction
  /// of that without pressure. The formula is valid up to about 1e8 Pa and, without pressure, up to about 90 K above
  /// T_0. At higher compression it would make c_v and then the compressibility vanish: at .89 and .86 of the volume at
  /// 300 K.
  static constexpr double least = 0.25;

  /// The heat capacity at constant volume c_v [J/(kg K)].
  double heatAtConstantVolume(const Point& at) const {
    const double difference = at.temperature * at.byTemperature * at.byTemperature / at.byPressure;
    return std::max(at.heat - difference, least / (1 - least) * difference);
  }
  /// The smaller root p of the quadratic equation v(p, T) = v, at which the volume of the liquid decreases with
  /// pressure. The curve ends at the pressure at which the fraction `least` of the compressibility is left, and
  /// continues along its tangent there.
  Point pointAt(const Deformation& d) const {
    const double volume = d.deformationGradient.determinant() / material.density, t = d.temperature;
    const double warm = t - densestTemperature, bent = 2 * curvature * pressureShift;
    const double slope = compressibility - bent * warm, excess = 1 + curvature * warm * warm - volume / densestVolume;
    const double root = std::sqrt(std::max(slope * slope - 2 * bent * pressureShift * excess, 0.0));
    const double end = (1 - least) * slope / (bent * pressureShift);
    const double beyond = root < least * slope ? excess - 0.5 * (1 + least) * slope * end : 0;
    const double pressure = beyond > 0 ? end + beyond / (least * slope) : 2 * excess / (slope + root);
    const double curved = std::min(pressure, end), straight = pressure - curved;
    return {volume,
            t,
            pressure,
            densestVolume * (slope - bent * pressureShift * curved),
            densestVolume * (2 * curvature * (warm + pressureShift * curved) + least * bent * straight),
            specificHeat - heatSlope * warm -
                2 * densestVolume * curvature * t * (curved + (1 - (1 - least) * (1 - least)) * straight)};
  }
};
static_assert(ConstitutiveModel<ThWater>);

}  // namespace tushar::mpm::solid
