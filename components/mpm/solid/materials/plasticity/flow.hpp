#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <variant>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// What the yield stress depends on.
struct FlowState {
  double plasticStrain;  ///< equivalent plastic strain, 1
  double strainRate;     ///< equivalent strain rate, 1/s
  double temperature;    ///< K
};

/// sigma_y = sigma_Y + K e_p
struct IsotropicHardening {
  static constexpr std::string_view name = "isotropic_hardening";

  double yieldStress = 0;  ///< sigma_Y, Pa
  double modulus = 0;      ///< K, Pa

  static const input::Schema<IsotropicHardening>& schema() {
    static const input::Schema<IsotropicHardening> schema =
        input::Schema<IsotropicHardening>("flow_model", "A yield stress that grows with the plastic strain.")
            .required("sigma_Y", &IsotropicHardening::yieldStress, "Pa", "at the start", input::positive())
            .required("K", &IsotropicHardening::modulus, "Pa", "its growth with the plastic strain", input::nonNegative());
    return schema;
  }
  double flowStress(const FlowState& state) const { return yieldStress + modulus * state.plasticStrain; }
  /// d sigma_y / d e_p
  double hardening(const FlowState&) const { return modulus; }
};

/// sigma_y = (A + B e_p^n) (1 + C ln e*) (1 - T*^m), e* = rate / epdot_0, T* = (T - T_r) / (T_m - T_r): Johnson & Cook,
/// Proc. 7th Int. Symp. on Ballistics (1983) 541. Below epdot_0 the factor of the rate is (1 + e*)^C, below T_r that of
/// the temperature 1 - T*, above T_m nothing, as in Uintah.
struct JohnsonCook {
  static constexpr std::string_view name = "johnson_cook";

  double a = 0, b = 0;               ///< Pa
  double c = 0, n = 0, m = 0;        ///< 1
  double referenceRate = 1;          ///< epdot_0, 1/s
  double roomTemperature = 298;      ///< T_r, K
  double meltTemperature = 1793;     ///< T_m, K

  static const input::Schema<JohnsonCook>& schema() {
    static const input::Schema<JohnsonCook> schema =
        input::Schema<JohnsonCook>("flow_model", "The yield stress of Johnson and Cook.")
            .required("A", &JohnsonCook::a, "Pa", "yield stress at the start", input::positive())
            .required("B", &JohnsonCook::b, "Pa", "factor of e_p^n", input::nonNegative())
            .required("C", &JohnsonCook::c, "1", "factor of the logarithm of the rate", input::nonNegative())
            .required("n", &JohnsonCook::n, "1", "exponent of the plastic strain", input::positive())
            .required("m", &JohnsonCook::m, "1", "exponent of the temperature", input::positive())
            .value("epdot_0", &JohnsonCook::referenceRate, 1, "1/s", "rate of the constants", input::positive())
            .value("T_r", &JohnsonCook::roomTemperature, 298, "K", "temperature of the constants", input::nonNegative())
            .value("T_m", &JohnsonCook::meltTemperature, 1793, "K", "temperature without strength", input::positive());
    return schema;
  }
  double flowStress(const FlowState& state) const {
    return (a + b * std::pow(state.plasticStrain, n)) * rateFactor(state) * temperatureFactor(state);
  }
  double hardening(const FlowState& state) const {
    if (state.plasticStrain <= 0) return 0;
    return b * n * std::pow(state.plasticStrain, n - 1) * rateFactor(state) * temperatureFactor(state);
  }

 private:
  double rateFactor(const FlowState& state) const {
    const double rate = state.strainRate / referenceRate;
    return rate < 1 ? std::pow(1 + rate, c) : 1 + c * std::log(rate);
  }
  double temperatureFactor(const FlowState& state) const {
    const double t = std::min((state.temperature - roomTemperature) / (meltTemperature - roomTemperature), 1.0);
    return t < 0 ? 1 - t : 1 - std::pow(t, m);
  }
};

using FlowModel = std::variant<IsotropicHardening, JohnsonCook>;

/// By how much the return shortens the trial stress s: the root q of |s| - q = (2/3)^(1/2) sigma_y(e_p + (2/3)^(1/2) q/(2 G)),
/// Pa, by Newton's iteration between bounds; Simo & Hughes, Computational Inelasticity (1998), box 3.1. `state` goes to
/// the end of the step.
template <class Flow>
double radialReturn(const Flow& flow, double trialSize, double shearModulus, FlowState& state) {
  const double root = std::sqrt(2.0 / 3.0), perStress = root / (2 * shearModulus), start = state.plasticStrain;
  double low = 0, high = trialSize - root * flow.flowStress(state), q = high;
  if (high <= 0) return 0;
  for (int step = 0; step < 100; ++step) {
    state.plasticStrain = start + perStress * q;
    const double excess = trialSize - q - root * flow.flowStress(state);
    (excess > 0 ? low : high) = q;
    if (std::abs(excess) <= 1e-14 * trialSize) break;
    const double slope = 1 + root * perStress * flow.hardening(state), newton = q + excess / slope;
    q = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  state.plasticStrain = start + perStress * q;
  return q;
}

}  // namespace tushar::mpm::solid
