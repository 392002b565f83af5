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
  double pressureShift = 0;           ///< a, K/Pa
  double heatSlope = 0;               ///< b, J/(kg K²)
  double specificHeat = 0;            ///< c_0, J/(kg K)
  double compressibility = 0;         ///< k, 1/Pa
  double densestTemperature = 0;      ///< T_0, K
  double curvature = 0;               ///< L, 1/K²
  double densestVolume = 0;           ///< v_0, m^3/kg
  double referencePressure = 101325;  ///< at which there is no stress, Pa

  static const input::Schema<ThWater>& schema() {
    using Self = ThWater;
    static const input::Schema<Self> schema =
        input::Schema<Self>("TH_water", "Water of Thomsen & Hartka, without viscosity.")
            .required("a", &Self::pressureShift, "K/Pa", "how fast pressure lowers the temperature of greatest density",
                      input::positive())
            .required("b", &Self::heatSlope, "J/(kg K²)", "how fast heat lowers the heat capacity")
            .required("co", &Self::specificHeat, "J/(kg K)", "heat capacity at <To> without pressure",
                      input::positive())
            .required("ko", &Self::compressibility, "1/Pa", "compressibility at <To> without pressure",
                      input::positive())
            .required("To", &Self::densestTemperature, "K", "temperature of greatest density without pressure",
                      input::positive())
            .required("L", &Self::curvature, "1/K²", "how fast volume grows away from <To>", input::positive())
            .required("vo", &Self::densestVolume, "m^3/kg", "volume at <To> without pressure", input::positive())
            .value("Pref", &Self::referencePressure, 101325, "Pa", "pressure that surrounds the bodies");
    return schema;
  }
  State initialState() const { return {}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    return (referencePressure - pointAt(d).pressure) * Matrix3::Identity();
  }
  /// c² = -v² (dp/dv)_s
  double waveSpeed(double, const Deformation& d, const Matrix3&, const State&) const {
    const Point at = pointAt(d);
    return at.volume / std::sqrt(at.byPressure - at.temperature * at.byTemperature * at.byTemperature / at.heat);
  }
  double temperatureChange(const Deformation& d, const Matrix3&, const State&) const {
    const Point at = pointAt(d);
    const double growth = 1 - d.oldDeformationGradient.determinant() / d.deformationGradient.determinant();
    const double steepness = at.byTemperature / at.byPressure;  // (dp/dT)_v, Pa/K
    const double heatAtConstantVolume = at.heat - at.temperature * at.byTemperature * steepness;
    return -at.temperature * steepness * at.volume * growth / heatAtConstantVolume;
  }
  /// 0 as in Uintah, so that StrainEnergy can be compared.
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }

 private:
  struct Point {
    double volume;         ///< v, m^3/kg
    double temperature;    ///< T, K
    double pressure;       ///< p, Pa
    double byPressure;     ///< -(dv/dp)_T, m^3/(kg Pa)
    double byTemperature;  ///< (dv/dT)_p, m^3/(kg K)
    double heat;           ///< c_p, J/(kg K)
  };
  /// The smaller root of the quadratic equation that v(p, T) is for p: the liquid whose volume falls under pressure.
  /// Pressed beyond the least volume of that equation, p goes on growing with the density.
  Point pointAt(const Deformation& d) const {
    const double volume = d.deformationGradient.determinant() / material.density, t = d.temperature;
    const double warm = t - densestTemperature, bent = 2 * curvature * pressureShift;
    const double slope = compressibility - bent * warm, excess = 1 + curvature * warm * warm - volume / densestVolume;
    const double root = std::sqrt(std::max(slope * slope - 2 * bent * pressureShift * excess, 0.0));
    const double pressure = 2 * excess / (slope + root), shifted = warm + pressureShift * pressure;
    return {volume,
            t,
            pressure,
            densestVolume * (compressibility - bent * shifted),
            2 * densestVolume * curvature * shifted,
            specificHeat - heatSlope * warm - 2 * densestVolume * curvature * t * pressure};
  }
};
static_assert(ConstitutiveModel<ThWater>);

}  // namespace tushar::mpm::solid
