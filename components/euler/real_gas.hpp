#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/euler/heat_of_air.hpp"

namespace tushar::euler {

/// A gas whose molecules have a volume and attract each other, p = R T / (v - b) - a / ((v + u b) (v + w b)) with v = 1
/// / rho, or an ideal gas (a = b = 0). Its c_v is constant or that of air. Its energy is the thermal energy plus the
/// energy of attraction, which is negative and rises with v: de/dv = a / ((v + u b) (v + w b)) at constant T. Source:
/// C. H. Twu, W. D. Sim & V. Tassone, Fluid Phase Equilib. 194 (2002) 385, for this form with u = -.5, w = 3.
class RealGas {
 public:
  struct Numbers {
    double gasConstant = 0;   ///< R, J/(kg K)
    double specificHeat = 0;  ///< c_v, J/(kg K)
    double attraction = 0;    ///< a, Pa m^6/kg²
    double covolume = 0;      ///< b, m³/kg
    double u = 0, w = 0;
    bool isAir = false;  ///< whether c_v is that of HeatOfAir
  };
  explicit RealGas(const Numbers& numbers) : n_(numbers) {}

  double gasConstant() const { return n_.gasConstant; }
  /// The volume b of the molecules [m³/kg].
  double covolume() const { return n_.covolume; }

  static bool isBarotropic() { return false; }
  double pressure(double rho, double energy) const { return lastAt(rho, temperature(rho, energy)); }
  double last(double rho, double energy) const { return pressure(rho, energy); }
  static double pressureOf(double, double last) { return last; }
  double energyOf(double rho, double last) const {
    return rho * (heatOf(temperatureOf(1 / rho, last)) + energyOfForces(1 / rho));
  }
  /// c² = v² (-dp/dv + T (dp/dT)² / c_v), where dp/dv is at constant T and dp/dT at constant v.
  double soundSpeedSquared(double rho, double last) const {
    const double v = 1 / rho, t = temperatureOf(v, last), perKelvin = n_.gasConstant / room(v), b = n_.covolume;
    const double slope = perKelvin * t / room(v) - forces(v) * (1 / (v + n_.u * b) + 1 / (v + n_.w * b));
    return v * v * (slope + t * perKelvin * perKelvin / specificHeatAt(t));
  }
  /// A number of the sign of the temperature, rho c_v T with the constant Numbers::specificHeat; it is greater than 0
  /// in possible states.
  double heat(double rho, double last) const {
    return room(1 / rho) > 0 ? rho * n_.specificHeat * temperatureOf(1 / rho, last) : -1;
  }
  bool canBe(double rho, double energy) const {
    if (!(room(1 / rho) > 0) || !(energy > leastEnergy(rho))) return false;
    return !(n_.attraction > 0) || soundSpeedSquared(rho, pressure(rho, energy)) > 0;
  }
  double leastEnergy(double rho) const { return rho * energyOfForces(1 / rho); }
  static double greatestEnergy(double) { return std::numeric_limits<double>::infinity(); }
  double temperature(double rho, double energy) const {
    const double own = energy / rho - energyOfForces(1 / rho);
    return n_.isAir ? HeatOfAir::temperature(own / n_.gasConstant) : own / n_.specificHeat;
  }
  double lastAt(double rho, double temperature) const {
    return n_.gasConstant * temperature / room(1 / rho) - forces(1 / rho);
  }
  /// The density of the gas, not of its liquid, at a given pressure and temperature, by bisection to round-off.
  double densityAt(double pressure, double temperature) const {
    double least = 0, most = pressure / (n_.gasConstant * temperature);
    if (n_.covolume == 0 && n_.attraction == 0) return most;
    const double densest = n_.covolume > 0 ? 1 / n_.covolume : std::numeric_limits<double>::infinity();
    const auto below = [&](double rho) { return rho < densest && lastAt(rho, temperature) < pressure; };
    for (int k = 0; k < 1000 && below(most); ++k) {
      least = most;
      most = std::min(1.1 * most, 0.5 * (most + densest));
    }
    for (int k = 0; k < 200; ++k) {
      const double middle = 0.5 * (least + most);
      if (middle <= least || middle >= most) break;
      (below(middle) ? least : most) = middle;
    }
    return most;
  }
  /// The entropy per mass divided by the constant Numbers::specificHeat.
  double entropy(double rho, double energy) const {
    const double t = temperature(rho, energy), ratio = n_.gasConstant / n_.specificHeat;
    return (n_.isAir ? ratio * HeatOfAir::entropy(t) : std::log(t)) + ratio * std::log(room(1 / rho));
  }
  /// The approximate ratio p / (rho u²) behind a strong shock that accelerates gas at rest to the speed u.
  double shockSlope() const { return 1 + 0.5 * n_.gasConstant / n_.specificHeat; }

 private:
  double room(double v) const { return v - n_.covolume; }
  double forces(double v) const {
    if (n_.attraction == 0) return 0;  // without divisions
    return n_.attraction / ((v + n_.u * n_.covolume) * (v + n_.w * n_.covolume));
  }
  /// The energy of attraction: the integral of forces(v) from infinity [J/kg].
  double energyOfForces(double v) const {
    if (n_.attraction == 0) return 0;
    const double low = v + n_.u * n_.covolume, apart = (n_.w - n_.u) * n_.covolume;
    return apart == 0 ? -n_.attraction / low : -n_.attraction / apart * std::log1p(apart / low);
  }
  double temperatureOf(double v, double pressure) const { return (pressure + forces(v)) * room(v) / n_.gasConstant; }
  double specificHeatAt(double t) const {
    return n_.isAir ? n_.gasConstant * HeatOfAir::specificHeat(t) : n_.specificHeat;
  }
  /// The thermal energy per mass [J/kg].
  double heatOf(double t) const { return n_.isAir ? n_.gasConstant * HeatOfAir::energy(t) : n_.specificHeat * t; }

  Numbers n_;
};

}  // namespace tushar::euler
