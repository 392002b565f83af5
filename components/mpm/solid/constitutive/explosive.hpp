#pragma once

#include <array>
#include <cmath>
#include <string>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The equation of state of an explosive before it burns, p = (J^-n - 1) / (n kappa): Murnaghan, Proc. Natl. Acad. Sci.
/// 30 (1944) 244.
struct Murnaghan {
  double compressibility = 0;  ///< kappa [1/Pa]
  double exponent = 0;         ///< exponent n [1]

  /// Pressure [Pa] at relative volume J.
  double pressure(double j) const { return (std::pow(j, -exponent) - 1) / (exponent * compressibility); }
  /// Stiffness -dp/dJ [Pa].
  double stiffness(double j) const { return std::pow(j, -exponent - 1) / compressibility; }
  /// Relative volume J at which the pressure is p [Pa].
  double relativeVolume(double p) const { return std::pow(1 + exponent * compressibility * p, -1 / exponent); }
};

/// The isentrope of the detonation products, p = A exp(-R1 J) + B exp(-R2 J) + C J^-(1 + omega): Lee, Hornig & Kury,
/// Adiabatic Expansion of High Explosive Detonation Products, UCRL-50422 (1968).
struct Jwl {
  double a = 0, b = 0, c = 0;  ///< A, B, C [Pa]
  double r1 = 0, r2 = 0;       ///< R1, R2 [1]
  double omega = 0;            ///< omega [1]

  /// Pressure [Pa] at relative volume J.
  double pressure(double j) const {
    return a * std::exp(-r1 * j) + b * std::exp(-r2 * j) + c * std::pow(j, -1 - omega);
  }
  /// Stiffness -dp/dJ [Pa].
  double stiffness(double j) const {
    return r1 * a * std::exp(-r1 * j) + r2 * b * std::exp(-r2 * j) + (1 + omega) * c * std::pow(j, -2 - omega);
  }
};

/// Pressure [Pa] of an explosive of which a fraction F has burned: Souers & al., Propellants, Explos., Pyrotech. 25
/// (2000) 54, equation 5.
inline double mixedPressure(const Murnaghan& unburned, const Jwl& burned, double fraction, double j) {
  return (1 - fraction) * unburned.pressure(j) + fraction * burned.pressure(j);
}

/// Declares a tag with three numbers. A model stores them in an array, because it must be trivially copyable.
template <class S>
void declareVector(input::Schema<S>& tags, const std::string& tag, std::array<double, 3> S::*member, bool isRequired,
                   const std::string& sentence) {
  const auto read = [=](S& object, const input::Element& element, input::Diagnostics& diagnostics) {
    const auto given = element.child(tag);
    if (!given && isRequired) diagnostics.error(element, "missing tag <" + tag + "> (" + sentence + ")");
    if (!given) return;
    const auto value = input::parse<Vec3>(given->text());
    if (!value.problem.empty()) return diagnostics.error(*given, value.problem);
    object.*member = {(*value.value)[0], (*value.value)[1], (*value.value)[2]};
  };
  tags.custom(tag, read, {tag}, sentence)
      .forms({input::typeForm({tag}, std::string(input::typeName<Vec3>), isRequired ? 1 : 0)});
}

}  // namespace tushar::mpm::solid
