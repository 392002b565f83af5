#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tushar::euler {

/// The cold curve of a substance: pressure [Pa] and energy [J/m³] as functions of density, with dE/drho = (E + p) /
/// rho, so that the energy rises by the work of compression without heat.
struct ColdCurve {
  enum class Kind { jwl, murnaghan, linear };

  Kind kind = Kind::jwl;
  double density = 1;  ///< density rho_0 [kg/m³]
  /// p = A exp(-R1 V) + B exp(-R2 V) + C V^-(1 + omega), V = rho_0 / rho; the energy is 0 at V = infinity.
  /// Source: E. L. Lee, H. C. Hornig & J. W. Kury, Adiabatic expansion of high explosive detonation products,
  /// UCRL-50422 (1968).
  double a = 0, b = 0, c = 0, r1 = 1, r2 = 1, omega = 1;
  /// p = P0 + ((rho / rho_0)^n - 1) / (n K), with the compressibility K [1/Pa] at rho_0. Below rho_0, p = P0 (rho /
  /// rho_0)^(1 / (K P0)), which continues with the same slope and stays positive. The energy is 0 at rho_0. Source: F.
  /// D. Murnaghan, Proc. Natl. Acad. Sci. 30 (1944) 244.
  double exponent = 1, compressibility = 1, pressureThere = 1;
  /// p = P0 + A (rho / rho_0 - 1), with A in `a` and P0 in `pressureThere`; the energy is 0 at rho_0.

  double pressure(double rho) const {
    if (kind == Kind::linear) return pressureThere + a * (rho / density - 1);
    if (kind == Kind::murnaghan) return murnaghanPressure(rho / density);
    return pressureOf(termsAt(rho));
  }
  double energy(double rho) const {
    if (kind == Kind::linear) {
      const double ratio = rho / density;
      return (pressureThere - a) * (ratio - 1) + a * ratio * std::log(ratio);
    }
    if (kind == Kind::murnaghan) return rho / density * murnaghanEnergy(rho / density);
    return energyOf(rho, termsAt(rho));
  }
  /// The slope dp/drho [m²/s²].
  double slope(double rho) const {
    if (kind == Kind::linear) return a / density;
    if (kind == Kind::murnaghan) {
      const double ratio = rho / density;
      const double power = ratio >= 1 ? exponent : 1 / (compressibility * pressureThere);
      // Far below rho_0, pressure and stiffness vanish; a small slope remains, so that the speeds of waves stay
      // distinct.
      return std::max(std::pow(ratio, power - 1), 1e-12) / (compressibility * density);
    }
    return slopeOf(rho, termsAt(rho));
  }
  /// The pressure with the energy, or with the slope, with the same bits as alone; jwl computes its exponentials once.
  std::pair<double, double> pressureAndEnergy(double rho) const {
    if (kind != Kind::jwl) return {pressure(rho), energy(rho)};
    const Terms terms = termsAt(rho);
    return {pressureOf(terms), energyOf(rho, terms)};
  }
  std::pair<double, double> pressureAndSlope(double rho) const {
    if (kind != Kind::jwl) return {pressure(rho), slope(rho)};
    const Terms terms = termsAt(rho);
    return {pressureOf(terms), slopeOf(rho, terms)};
  }

 private:
  /// The volume ratio V, the two exponentials without their factors, and the last term of jwl.
  struct Terms {
    double volume, first, second, tail;
  };
  Terms termsAt(double rho) const {
    const double volume = density / rho;
    return {volume, decay(r1 * volume), decay(r2 * volume), tail(volume)};
  }
  double pressureOf(const Terms& of) const { return a * of.first + b * of.second + of.tail; }
  double energyOf(double rho, const Terms& of) const {
    const double perMass = a / r1 * of.first + b / r2 * of.second;
    return rho / density * (perMass + of.volume / omega * of.tail);
  }
  double slopeOf(double rho, const Terms& of) const {
    const double sum = r1 * a * of.first + r2 * b * of.second;
    return (of.volume * sum + (1 + omega) * of.tail) / rho;
  }
  /// exp(-x), which is 0 for greater x, as in thin gas: the function of the library takes several times as long there.
  static double decay(double x) { return x > 746 ? 0.0 : std::exp(-x); }
  double tail(double volume) const { return c == 0 ? 0.0 : c * std::pow(volume, -1 - omega); }
  double murnaghanPressure(double ratio) const {
    if (ratio < 1) return pressureThere * std::pow(ratio, 1 / (compressibility * pressureThere));
    return pressureThere + (std::pow(ratio, exponent) - 1) / (exponent * compressibility);
  }
  /// The energy per mass times rho_0 [J/m³].
  double murnaghanEnergy(double ratio) const {
    if (ratio < 1) return pressureThere * rise(ratio, 1 / (compressibility * pressureThere));
    const double bulk = 1 / (exponent * compressibility);
    return (pressureThere - bulk) * (1 - 1 / ratio) + bulk * rise(ratio, exponent);
  }
  /// The integral of x^(m - 2) from 1 to `ratio`.
  static double rise(double ratio, double m) {
    return m == 1 ? std::log(ratio) : (std::pow(ratio, m - 1) - 1) / (m - 1);
  }
};

// The equations of state of gases that are not stiffened gases. A state consists of the density [kg/m³] and a second
// number, the last component, which together with the density determines pressure and energy. The second number is the
// pressure [Pa] or, if the pressure does not depend on the heat, the heat rho c_v T [J/m³].

/// The equation of state p = p_cold + Gamma rho c_v T, E = E_cold + rho c_v T, after Mie & Grüneisen. Gamma is
/// constant or, with a linear cold curve, Gamma rho is constant. With Gamma = 0 the pressure depends on the density
/// alone.
///
/// Where p_cold increases with the density, rho E_cold is convex; hence a mean of admissible states has a positive
/// heat.
class CurvedGas {
 public:
  /// `gamma` is the Grüneisen parameter, at least 0; with a linear cold curve it is the value at rho_0. The specific
  /// heat c_v is in J/(kg K).
  CurvedGas(const ColdCurve& cold, double gamma, double specificHeat)
      : cold_(cold), gamma_(gamma), specificHeat_(specificHeat) {}

  const ColdCurve& cold() const { return cold_; }
  /// The Grüneisen parameter; with a linear cold curve, its value at rho_0.
  double gruneisen() const { return gamma_; }
  bool isBarotropic() const { return gamma_ == 0; }

  /// The pressure p [Pa] at a density and an internal energy per volume [J/m³].
  double pressure(double rho, double energy) const {
    if (isBarotropic()) return cold_.pressure(rho);
    const auto [coldPressure, coldEnergy] = cold_.pressureAndEnergy(rho);
    return coldPressure + gammaAt(rho) * (energy - coldEnergy);
  }
  /// The last component of the state with a given density and internal energy per volume.
  double last(double rho, double energy) const {
    return isBarotropic() ? energy - cold_.energy(rho) : pressure(rho, energy);
  }
  double pressureOf(double rho, double last) const { return isBarotropic() ? cold_.pressure(rho) : last; }
  double energyOf(double rho, double last) const {
    if (isBarotropic()) return cold_.energy(rho) + last;
    const auto [coldPressure, coldEnergy] = cold_.pressureAndEnergy(rho);
    return coldEnergy + (last - coldPressure) / gammaAt(rho);
  }
  /// The squared speed of sound, c² = p_cold' + (1 + Gamma) (p - p_cold) / rho; if Gamma rho is constant, Gamma
  /// replaces 1 + Gamma.
  double soundSpeedSquared(double rho, double last) const {
    if (isBarotropic()) return cold_.slope(rho);
    const auto [coldPressure, slope] = cold_.pressureAndSlope(rho);
    return slope + (isLinear() ? gammaAt(rho) : 1 + gamma_) * (last - coldPressure) / rho;
  }
  /// The thermal energy per volume; it is greater than 0 in possible states.
  double heat(double rho, double last) const {
    return isBarotropic() ? last : (last - cold_.pressure(rho)) / gammaAt(rho);
  }
  bool canBe(double rho, double energy) const { return energy > cold_.energy(rho); }
  double leastEnergy(double rho) const { return cold_.energy(rho); }
  static double greatestEnergy(double) { return std::numeric_limits<double>::infinity(); }

  double temperature(double rho, double energy) const { return (energy - cold_.energy(rho)) / (rho * specificHeat_); }
  /// The last component of the state with a given density and temperature [K].
  double lastAt(double rho, double temperature) const {
    const double heat = rho * specificHeat_ * temperature;
    return isBarotropic() ? heat : cold_.pressure(rho) + gammaAt(rho) * heat;
  }
  /// The density rho at a given pressure and temperature, by bisection to round-off.
  double densityAt(double pressure, double temperature) const {
    const auto below = [&](double rho) { return pressureOf(rho, lastAt(rho, temperature)) < pressure; };
    double least = cold_.density, most = cold_.density;
    while (!below(least) && least > 1e-300) least *= 0.5;
    while (below(most) && most < 1e300) most *= 2;
    for (int k = 0; k < 200 && least < most; ++k) {
      const double middle = 0.5 * (least + most);
      if (middle <= least || middle >= most) break;
      (below(middle) ? least : most) = middle;
    }
    return most;
  }
  /// The entropy per mass over c_v, up to a constant: ln T minus the integral of Gamma d(ln rho).
  double entropy(double rho, double energy) const {
    return std::log(temperature(rho, energy)) + (isLinear() ? gammaAt(rho) : -gamma_ * std::log(rho));
  }
  /// The approximate ratio p / (rho u²) behind a strong shock that accelerates gas at rest to the speed u.
  double shockSlope() const {
    return 0.5 * (cold_.kind == ColdCurve::Kind::murnaghan ? cold_.exponent + 1 : gamma_ + 2);
  }

 private:
  bool isLinear() const { return cold_.kind == ColdCurve::Kind::linear; }
  double gammaAt(double rho) const { return isLinear() ? gamma_ * cold_.density / rho : gamma_; }

  ColdCurve cold_;
  double gamma_, specificHeat_;
};

/// Water: v = v_0 (1 - k_0 p + L x²), x = a p + T - T_0. Its specific heat at p = 0 is c_p = c_0 + b (T_0 - T); at
/// other pressures, it follows from v. The law is valid for x > 0, that is, above the temperature of greatest density,
/// and up to the x at which c_v has fallen to half of c_p at p = 0. At a slightly greater x, water would become denser
/// without any pressure. Source: J. S. Thomsen & T. J. Hartka, Am. J. Phys. 30 (1962) 26.
class Water {
 public:
  struct Numbers {
    double a = 2e-7;           ///< a [K/Pa]
    double b = 2.6;            ///< b [J/(kg K²)]
    double heat = 4205.7;      ///< specific heat c_0 [J/(kg K)]
    double stiffness = 5e-10;  ///< compressibility k_0 [1/Pa]
    double temperature = 277;  ///< temperature T_0 [K]
    double bend = 8e-6;        ///< curvature L of the volume around T_0 [1/K²]
    double volume = 1e-3;      ///< volume v_0 [m³/kg]
  };
  explicit Water(const Numbers& numbers) : n_(numbers) {
    double least = 0, most = 0.5 * n_.stiffness / (n_.bend * n_.a);
    for (int k = 0; k < 60; ++k) {
      const double x = 0.5 * (least + most), t = n_.temperature + x;
      (heatOfVolume(0, t, x) > 0.5 * heatOfPressure(0, t) ? least : most) = x;
    }
    greatestX_ = least;
  }

  static bool isBarotropic() { return false; }
  double pressure(double rho, double energy) const {
    const double volume = 1 / rho, perMass = energy * volume;
    // At a given volume, the energy rises with x, which is between 0 and the greatest x.
    double least = 0, most = greatestX_, x = 0.2 * most;
    for (int k = 0; k < 100; ++k) {
      const double p = pressureAtX(volume, x), t = temperatureAt(p, x);
      const double excess = energyPerMass(p, t) - perMass;
      (excess > 0 ? most : least) = x;
      const double slope = heatOfVolume(p, t, x) * (1 - n_.a * 2 * n_.bend * x / n_.stiffness);
      double next = x - excess / slope;
      if (!(next > least) || !(next < most)) next = 0.5 * (least + most);
      const bool done = std::abs(next - x) <= 1e-15 * x;
      x = next;
      if (done) break;
    }
    return pressureAtX(volume, x);
  }
  double last(double rho, double energy) const { return pressure(rho, energy); }
  static double pressureOf(double, double last) { return last; }
  double energyOf(double rho, double last) const {
    return rho * energyPerMass(last, temperatureAt(last, xAt(rho, last)));
  }
  double soundSpeedSquared(double rho, double last) const {
    const double x = xAt(rho, last), t = temperatureAt(last, x);
    const double perHeat = expansion(x), perPressure = n_.volume * (2 * n_.bend * n_.a * x - n_.stiffness);
    return -1 / (rho * rho * (perPressure + t * perHeat * perHeat / heatOfPressure(last, t)));
  }
  /// A measure of the heat; it is greater than 0 in possible states.
  double heat(double rho, double last) const {
    const double square = xSquared(rho, last);
    return std::min(square, greatestX_ * greatestX_ - square);
  }
  bool canBe(double rho, double energy) const {
    const double perMass = energy / rho;
    return perMass > energyOfX(1 / rho, 0) && perMass < energyOfX(1 / rho, greatestX_);
  }
  double leastEnergy(double rho) const { return rho * energyOfX(1 / rho, 0); }
  double greatestEnergy(double rho) const { return rho * energyOfX(1 / rho, greatestX_); }
  double temperature(double rho, double energy) const {
    const double p = pressure(rho, energy);
    return temperatureAt(p, xAt(rho, p));
  }
  double lastAt(double rho, double temperature) const {
    // With x = a p + T - T_0, the equation for v becomes L x² + (k_0 / a) ((T - T_0) - x) + 1 - v / v_0 = 0.
    const double half = 0.5 * n_.stiffness / (n_.a * n_.bend), warmer = temperature - n_.temperature;
    const double rest = (2 * half * n_.bend * warmer + 1 - 1 / (rho * n_.volume)) / n_.bend;
    return (rest / (half + std::sqrt(half * half - rest)) - warmer) / n_.a;
  }
  double densityAt(double pressure, double temperature) const {
    const double x = n_.a * pressure + temperature - n_.temperature;
    return 1 / (n_.volume * (1 - n_.stiffness * pressure + n_.bend * x * x));
  }
  double entropy(double rho, double energy) const {
    const double p = pressure(rho, energy), t = temperatureAt(p, xAt(rho, p)), warmer = t - n_.temperature;
    const double alone = (n_.heat + n_.b * n_.temperature) * std::log(t) - n_.b * t;
    return (alone - n_.volume * n_.bend * p * (n_.a * p + 2 * warmer)) / n_.heat;
  }
  static double shockSlope() { return 2; }

  /// c_0 T_0 [J/kg]: the energy is measured from T_0, that of other gases from 0 K.
  double heatBelow() const { return n_.heat * n_.temperature; }
  /// Water at a pressure and a temperature, and its derivatives.
  struct Point {
    double volume, energy;             ///< per mass [m³/kg, J/kg]
    double ofPressure, ofTemperature;  ///< derivatives of the volume
    double heatOfPressure;             ///< c_p [J/(kg K)]
  };
  /// For solvers, which may pass through impossible states: at pressures that give more than the greatest x, the volume
  /// falls exponentially, and where even p = 0 does, the derivatives are those of the greatest x.
  Point at(double pressure, double t) const {
    const double warmer = t - n_.temperature, room = (greatestX_ - warmer) / n_.a;
    const double p = room > 0 ? std::min(pressure, room) : pressure, x = n_.a * p + warmer;
    const double valid = std::min(x, greatestX_);
    Point point{.volume = n_.volume * (1 - n_.stiffness * p + n_.bend * x * x),
                .energy = energyPerMass(p, t),
                .ofPressure = n_.volume * (2 * n_.bend * n_.a * valid - n_.stiffness),
                .ofTemperature = expansion(valid),
                .heatOfPressure = std::max(heatOfPressure(p, t), 0.1 * n_.heat)};
    if (pressure > p) {
      const double falls = std::exp(point.ofPressure * (pressure - p) / point.volume);
      point.volume *= falls;
      point.ofPressure *= falls;
    }
    return point;
  }
  /// The temperatures [K] between which the law is valid at p = 0.
  std::pair<double, double> temperatureLimits() const { return {n_.temperature, n_.temperature + greatestX_}; }
  /// Whether the law is valid up to the greatest x.
  bool isValid(double p, double t) const { return n_.a * p + t - n_.temperature <= greatestX_; }

 private:
  double xSquared(double rho, double p) const { return (1 / (rho * n_.volume) - 1 + n_.stiffness * p) / n_.bend; }
  double xAt(double rho, double p) const { return std::sqrt(xSquared(rho, p)); }
  double pressureAtX(double volume, double x) const {
    return (n_.bend * x * x + 1 - volume / n_.volume) / n_.stiffness;
  }
  double temperatureAt(double p, double x) const { return n_.temperature - n_.a * p + x; }
  /// The derivative dv/dT at constant p.
  double expansion(double x) const { return 2 * n_.volume * n_.bend * x; }
  double heatOfPressure(double p, double t) const {
    return n_.heat + n_.b * (n_.temperature - t) - 2 * n_.volume * n_.bend * p * t;
  }
  double heatOfVolume(double p, double t, double x) const {
    const double perPressure = n_.volume * (2 * n_.bend * n_.a * x - n_.stiffness);
    return heatOfPressure(p, t) + t * expansion(x) * expansion(x) / perPressure;
  }
  /// The energy per mass, e = c_0 w - b w² / 2 + v_0 (k_0 p² / 2 + L (a p (a p + ... ) ...)). It is h - p v, where h
  /// follows from dh = c_p dT + (v - T dv/dT) dp.
  double energyPerMass(double p, double t) const {
    const double w = t - n_.temperature, shift = n_.a * p;
    // (x³ - w³) / (3 a) and (x² - w²) / a with x = w + a p, without cancellation.
    const double cubes = p * (w * w + w * shift + shift * shift / 3), squares = p * (2 * w + shift);
    const double x = w + shift;
    const double ofPressure = 0.5 * n_.stiffness * p * p + n_.bend * (cubes - t * squares - p * x * x);
    return n_.heat * w - 0.5 * n_.b * w * w + n_.volume * ofPressure;
  }
  double energyOfX(double volume, double x) const {
    const double p = pressureAtX(volume, x);
    return energyPerMass(p, temperatureAt(p, x));
  }

  Numbers n_;
  double greatestX_ = 0;
};

}  // namespace tushar::euler
