#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tushar::euler {

/// The coefficients of 1 mol of O2 with 3.76 mol of N2.
constexpr std::array<double, 5> ofAir(const std::array<double, 5>& oxygen, const std::array<double, 5>& nitrogen) {
  std::array<double, 5> a{};
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = (oxygen[k] + 3.76 * nitrogen[k]) / 4.76;
  return a;
}

/// The specific heat of air (1 mol of O2 with 3.76 mol of N2), divided by its gas constant: c_p/R = a_0 + a_1 T + … +
/// a_4 T^4 for O2 and N2, weighted by mole fractions. Valid from 200 to 3500 K; below and above, c_v keeps its value at
/// the nearer limit. Energies are measured from 0 K. Source of the coefficients:
/// B. J. McBride, S. Gordon & M. A. Reno, NASA TM 4513 (1993), as in G. P. Smith & al., GRI-Mech 3.0 (1999).
class HeatOfAir {
  using Polynomial = std::array<double, 5>;

 public:
  /// c_v / R.
  static double specificHeat(double temperature) {
    const double t = std::clamp(temperature, least, most);
    const Polynomial& a = t < middle ? cold : hot;
    return (((a[4] * t + a[3]) * t + a[2]) * t + a[1]) * t + a[0] - 1;
  }
  /// e / R [K].
  static double energy(double t) {
    static const double atLeast = least * specificHeat(least);
    static const double atMiddle = atLeast + rise(cold, least, middle), atMost = atMiddle + rise(hot, middle, most);
    if (t <= least) return t * specificHeat(least);
    if (t < middle) return atLeast + rise(cold, least, t);
    if (t <= most) return atMiddle + rise(hot, middle, t);
    return atMost + (t - most) * specificHeat(most);
  }
  /// The integral of c_v / (R T).
  static double entropy(double t) {
    static const double atLeast = std::log(least) * specificHeat(least);
    static const double atMiddle = atLeast + entropyRise(cold, least, middle);
    static const double atMost = atMiddle + entropyRise(hot, middle, most);
    if (t <= least) return std::log(t) * specificHeat(least);
    if (t < middle) return atLeast + entropyRise(cold, least, t);
    if (t <= most) return atMiddle + entropyRise(hot, middle, t);
    return atMost + std::log(t / most) * specificHeat(most);
  }
  /// The temperature [K] at a given e / R [K], by Newton's method to round-off; it converges fast because c_v hardly
  /// varies.
  static double temperature(double energyOverR) {
    double t = energyOverR / specificHeat(least), last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 50; ++k) {
      const double change = (energyOverR - energy(t)) / specificHeat(t);
      t += change;
      if (!(std::abs(change) < last) || std::abs(change) <= 1e-16 * t) break;
      last = std::abs(change);
    }
    return t;
  }

 private:
  static constexpr double least = 200, middle = 1000, most = 3500;  // K
  static constexpr Polynomial cold = ofAir({3.78245636, -2.99673416e-3, 9.84730201e-6, -9.68129509e-9, 3.24372837e-12},
                                           {3.298677, 1.4082404e-3, -3.963222e-6, 5.641515e-9, -2.444854e-12});
  static constexpr Polynomial hot = ofAir({3.28253784, 1.48308754e-3, -7.57966669e-7, 2.09470555e-10, -2.16717794e-14},
                                          {2.92664, 1.4879768e-3, -5.68476e-7, 1.0097038e-10, -6.753351e-15});

  static double rise(const Polynomial& a, double from, double to) {
    const auto at = [&](double t) {
      return ((((a[4] / 5 * t + a[3] / 4) * t + a[2] / 3) * t + a[1] / 2) * t + a[0] - 1) * t;
    };
    return at(to) - at(from);
  }
  static double entropyRise(const Polynomial& a, double from, double to) {
    const auto at = [&](double t) { return (((a[4] / 4 * t + a[3] / 3) * t + a[2] / 2) * t + a[1]) * t; };
    return at(to) - at(from) + (a[0] - 1) * std::log(to / from);
  }
};

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
  /// The heat per volume; it is greater than 0 in possible states.
  double heat(double rho, double last) const {
    return room(1 / rho) > 0 ? rho * heatOf(temperatureOf(1 / rho, last)) : -1;
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
  double forces(double v) const { return n_.attraction / ((v + n_.u * n_.covolume) * (v + n_.w * n_.covolume)); }
  /// The energy of attraction: the integral of forces(v) from infinity [J/kg].
  double energyOfForces(double v) const {
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
