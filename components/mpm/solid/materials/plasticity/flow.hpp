#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <variant>

#include "core/input/schema.hpp"
#include "core/input/values.hpp"

namespace tushar::mpm::solid {

/// What the yield stress depends on.
struct FlowState {
  double plasticStrain;  ///< equivalent plastic strain, 1
  double strainRate;     ///< equivalent strain rate, 1/s
  double temperature;    ///< K
  double shearModulus;   ///< Pa
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
            .value("T_m", &JohnsonCook::meltTemperature, 1793, "K", "temperature without strength", input::positive())
            .check([](const JohnsonCook& read, const input::Element& element, input::Diagnostics& diagnostics) {
              if (read.meltTemperature <= read.roomTemperature)
                diagnostics.error(element, "T_m must be greater than T_r");
            });
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

/// sigma_y = min(sigma_0 (1 + beta (e_p + epsilon_p0))^n, Y_max) G/mu_0, whatever the rate: Steinberg, Cochran & Guinan, J.
/// Appl. Phys. 51 (1980) 1498.
struct SteinbergCochranGuinan {
  static constexpr std::string_view name = "steinberg_cochran_guinan";

  double shearModulus = 0;   ///< mu_0, Pa
  double yieldStress = 0;    ///< sigma_0, Pa
  double greatest = 0;       ///< Y_max, Pa
  double beta = 0, n = 0;    ///< 1
  double initialStrain = 0;  ///< epsilon_p0, 1

  static const input::Schema<SteinbergCochranGuinan>& schema() {
    using Self = SteinbergCochranGuinan;
    static const input::Schema<Self> schema =
        input::Schema<Self>("flow_model", "The yield stress of Steinberg, Cochran and Guinan, without thermal activation.")
            .required("mu_0", &Self::shearModulus, "Pa", "shear modulus of the constants", input::positive())
            .required("sigma_0", &Self::yieldStress, "Pa", "yield stress without hardening", input::positive())
            .required("Y_max", &Self::greatest, "Pa", "yield stress that hardening never passes", input::positive())
            .required("beta", &Self::beta, "1", "factor of the plastic strain", input::nonNegative())
            .required("n", &Self::n, "1", "exponent of the hardening", input::nonNegative())
            .value("epsilon_p0", &Self::initialStrain, 0, "1", "plastic strain at the start", input::nonNegative())
            .ignored("A", "the <shear_modulus_model> has it")
            .ignored("B", "the <shear_modulus_model> has it")
            .ignored("T_m0", "the <melting_temp_model> has it")
            .ignored("Gamma_0", "the <melting_temp_model> has it")
            .ignored("a", "the <melting_temp_model> has it");
    return schema;
  }
  double flowStress(const FlowState& state) const {
    return std::min(hardened(state), greatest) * state.shearModulus / shearModulus;
  }
  double hardening(const FlowState& state) const {
    if (hardened(state) >= greatest) return 0;
    return beta * n * hardened(state) / base(state) * state.shearModulus / shearModulus;
  }

 private:
  double base(const FlowState& state) const { return 1 + beta * (state.plasticStrain + initialStrain); }
  double hardened(const FlowState& state) const { return yieldStress * std::pow(base(state), n); }
};

/// sigma_y = c_0 + B exp(-beta T) + B_0 e_p^(1/2) exp(-alpha T) + K e_p^n, alpha = alpha_0 - alpha_1 ln rate, beta
/// likewise: Zerilli & Armstrong, J. Appl. Phys. 61 (1987) 1816. The rate is that of the whole strain, and at least 1e-8/s.
struct ZerilliArmstrong {
  static constexpr std::string_view name = "zerilli_armstrong";

  double c0 = 0, b = 0, b0 = 0, k = 0;  ///< Pa
  double n = 0;                         ///< 1
  double alpha0 = 0, alpha1 = 0;        ///< 1/K
  double beta0 = 0, beta1 = 0;          ///< 1/K

  static const input::Schema<ZerilliArmstrong>& schema() {
    using Self = ZerilliArmstrong;
    static const input::Schema<Self> schema =
        input::Schema<Self>("flow_model", "The yield stress of Zerilli and Armstrong.")
            .custom("c_0", readConstantPart, {"c_0", "sigma_g", "k_H", "sqrt_l_inv"},
                    "part that nothing changes, Pa; or <sigma_g> + <k_H> <sqrt_l_inv>, by the size of the grains")
            .required("B", &Self::b, "Pa", "part without hardening", input::nonNegative())
            .required("beta_0", &Self::beta0, "1/K", "its fall with the temperature", input::nonNegative())
            .required("beta_1", &Self::beta1, "1/K", "and with the logarithm of the rate", input::nonNegative())
            .required("B_0", &Self::b0, "Pa", "part that grows with the root of the plastic strain", input::nonNegative())
            .required("alpha_0", &Self::alpha0, "1/K", "its fall with the temperature", input::nonNegative())
            .required("alpha_1", &Self::alpha1, "1/K", "and with the logarithm of the rate", input::nonNegative())
            .required("K", &Self::k, "Pa", "factor of e_p^n", input::nonNegative())
            .required("n", &Self::n, "1", "exponent of the plastic strain", input::nonNegative());
    return schema;
  }
  double flowStress(const FlowState& state) const {
    const double ep = state.plasticStrain;
    return c0 + b * fading(beta0, beta1, state) + b0 * std::sqrt(ep) * fading(alpha0, alpha1, state) + k * std::pow(ep, n);
  }
  double hardening(const FlowState& state) const {
    const double ep = state.plasticStrain;
    if (ep <= 0) return 0;
    return 0.5 * b0 / std::sqrt(ep) * fading(alpha0, alpha1, state) + k * n * std::pow(ep, n - 1);
  }

 private:
  /// c_0, or Hall and Petch's sigma_g + k_H l^(-1/2) of grains of size l.
  static void readConstantPart(ZerilliArmstrong& read, const input::Element& element, input::Diagnostics& diagnostics) {
    std::array<double, 4> values{};
    for (std::size_t k = 0; const char* name : {"c_0", "sigma_g", "k_H", "sqrt_l_inv"}) {
      const auto given = element.child(name);
      const auto value = given ? input::parse<double>(given->text()) : input::parse<double>("0");
      if (!value.problem.empty()) diagnostics.error(*given, value.problem);
      values[k++] = value.value.value_or(0);
    }
    if (!element.child("c_0") && !element.child("sigma_g"))
      diagnostics.error(element, "missing tag <c_0> in <flow_model> (part that nothing changes)");
    read.c0 = values[0] + values[1] + values[2] * values[3];
    if (read.c0 < 0) diagnostics.error(element, "c_0 must be at least 0 Pa");
  }
  static double fading(double byTemperature, double byRate, const FlowState& state) {
    const double logarithm = std::log(std::max(state.strainRate, 1e-8));
    return std::exp(-(byTemperature - byRate * logarithm) * state.temperature);
  }
};

using FlowModel = std::variant<IsotropicHardening, JohnsonCook, SteinbergCochranGuinan, ZerilliArmstrong>;

/// By how much the return shortens the trial stress s: the root q of |s| - q = (2/3)^(1/2) sigma_y(e_p + (2/3)^(1/2) q/(2 G)),
/// Pa, by Newton's iteration between bounds; Simo & Hughes, Computational Inelasticity (1998), box 3.1. `state` goes to
/// the end of the step.
template <class Flow>
double radialReturn(const Flow& flow, double trialSize, FlowState& state) {
  const double root = std::sqrt(2.0 / 3.0), perStress = root / (2 * state.shearModulus), start = state.plasticStrain;
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
