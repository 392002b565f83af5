#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tushar::euler {

/// The specific heat of air at temperatures from 200 to 3500 K: polynomials c_p/R = a_0 + a_1 T + … + a_4 T^4 below and
/// above 1000 K.
namespace polynomials_of_air {

using Polynomial = std::array<double, 5>;

inline constexpr double least = 200, middle = 1000, most = 3500;  ///< limits of the polynomials [K]

/// The coefficients of 1 mol of O2 with 3.76 mol of N2.
constexpr Polynomial ofAir(const Polynomial& oxygen, const Polynomial& nitrogen) {
  Polynomial a{};
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = (oxygen[k] + 3.76 * nitrogen[k]) / 4.76;
  return a;
}
inline constexpr Polynomial cold = ofAir({3.78245636, -2.99673416e-3, 9.84730201e-6, -9.68129509e-9, 3.24372837e-12},
                                         {3.298677, 1.4082404e-3, -3.963222e-6, 5.641515e-9, -2.444854e-12});
inline constexpr Polynomial hot = ofAir({3.28253784, 1.48308754e-3, -7.57966669e-7, 2.09470555e-10, -2.16717794e-14},
                                        {2.92664, 1.4879768e-3, -5.68476e-7, 1.0097038e-10, -6.753351e-15});

/// c_v / R.
constexpr double heat(double t) {
  const Polynomial& a = t < middle ? cold : hot;
  return (((a[4] * t + a[3]) * t + a[2]) * t + a[1]) * t + a[0] - 1;
}
/// The coefficients of the integral of c_v / R over T, without the constant, and the integral.
constexpr Polynomial integralOf(const Polynomial& a) { return {a[0] - 1, a[1] / 2, a[2] / 3, a[3] / 4, a[4] / 5}; }
constexpr double integral(const Polynomial& b, double t) {
  return ((((b[4] * t + b[3]) * t + b[2]) * t + b[1]) * t + b[0]) * t;
}
inline constexpr Polynomial ofCold = integralOf(cold), ofHot = integralOf(hot);
/// The constants of the integrals, so that e = c_v T at the lower limit, and e is continuous.
inline constexpr double coldConstant = least * heat(least) - integral(ofCold, least);
inline constexpr double hotConstant = coldConstant + integral(ofCold, middle) - integral(ofHot, middle);
/// e / R [K].
constexpr double energy(double t) {
  return t < middle ? coldConstant + integral(ofCold, t) : hotConstant + integral(ofHot, t);
}

/// Temperatures, and their slopes, at equidistant energies between the limits.
struct Inverse {
  static constexpr std::size_t parts = 256;
  double from = energy(least), to = energy(most), perKelvin = parts / (to - from);
  std::array<double, parts + 1> temperatures{}, rises{};  ///< T [K], and dT/de times the distance of energies [K]

  constexpr Inverse() {
    double t = least;
    for (std::size_t k = 0; k <= parts; ++k) {
      const double wanted = from + static_cast<double>(k) / perKelvin;
      for (int n = 0; n < 20; ++n) t += (wanted - energy(t)) / heat(t);
      temperatures[k] = t;
      rises[k] = 1 / (heat(t) * perKelvin);
    }
  }
  /// Hermite's cubic interpolation.
  double at(double energyOverR) const {
    const double place = (energyOverR - from) * perKelvin;
    const std::size_t k = std::min(static_cast<std::size_t>(place), parts - 1);
    const double x = place - static_cast<double>(k), rise = temperatures[k + 1] - temperatures[k];
    return temperatures[k] + x * (rise + (1 - x) * ((1 - x) * (rises[k] - rise) - x * (rises[k + 1] - rise)));
  }
};
inline constexpr Inverse inverse{};

}  // namespace polynomials_of_air

/// The specific heat of air (1 mol of O2 with 3.76 mol of N2), divided by its gas constant: polynomials for O2 and N2,
/// weighted by mole fractions. Valid from 200 to 3500 K; below and above, c_v keeps its value at the nearer limit.
/// Energies are measured from 0 K. Source of the coefficients:
/// B. J. McBride, S. Gordon & M. A. Reno, NASA TM 4513 (1993), as in G. P. Smith & al., GRI-Mech 3.0 (1999).
struct HeatOfAir {
  /// c_v / R.
  static double specificHeat(double temperature) {
    using namespace polynomials_of_air;
    return heat(std::clamp(temperature, least, most));
  }
  /// e / R [K].
  static double energy(double t) {
    using namespace polynomials_of_air;
    if (t <= least) return t * heat(least);
    return t <= most ? polynomials_of_air::energy(t) : inverse.to + (t - most) * heat(most);
  }
  /// The integral of c_v / (R T).
  static double entropy(double t) {
    using namespace polynomials_of_air;
    static const double atLeast = std::log(least) * heat(least);
    static const double atMiddle = atLeast + entropyRise(cold, least, middle);
    static const double atMost = atMiddle + entropyRise(hot, middle, most);
    if (t <= least) return std::log(t) * heat(least);
    if (t < middle) return atLeast + entropyRise(cold, least, t);
    if (t <= most) return atMiddle + entropyRise(hot, middle, t);
    return atMost + std::log(t / most) * heat(most);
  }
  /// The temperature [K] at a given e / R [K], to round-off: one step of Newton's method after interpolation in a table
  /// with a relative error below 1e-8, since the error of such a step is less than the square of that before.
  static double temperature(double energyOverR) {
    using namespace polynomials_of_air;
    if (!(energyOverR > inverse.from)) return energyOverR / heat(least);
    if (!(energyOverR < inverse.to)) return most + (energyOverR - inverse.to) / heat(most);
    const double t = inverse.at(energyOverR);
    return t + (energyOverR - polynomials_of_air::energy(t)) / heat(t);
  }

 private:
  static double entropyRise(const polynomials_of_air::Polynomial& a, double from, double to) {
    const auto at = [&](double t) { return (((a[4] / 4 * t + a[3] / 3) * t + a[2] / 2) * t + a[1]) * t; };
    return at(to) - at(from) + (a[0] - 1) * std::log(to / from);
  }
};

}  // namespace tushar::euler
