#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <variant>

#include "components/mpm/solid/constitutive/plasticity/mts.hpp"
#include "components/mpm/solid/constitutive/plasticity/ptw.hpp"
#include "components/mpm/solid/constitutive/plasticity/scg.hpp"
#include "core/input/schema.hpp"
#include "core/input/values.hpp"

namespace tushar::mpm::solid {

/// Linear isotropic hardening: sigma_y = sigma_Y + K e_p.
struct IsotropicHardening {
  using Capabilities = CapabilityList<capability::Hardening>;
  static constexpr std::string_view name = "isotropic_hardening";

  double yieldStress = 0;  ///< sigma_Y [Pa]
  double modulus = 0;      ///< modulus K [Pa]

  static const input::Schema<IsotropicHardening>& schema() {
    static const input::Schema<IsotropicHardening> schema =
        input::Schema<IsotropicHardening>("flow_model", "A yield stress that grows with the plastic strain.")
            .required("sigma_Y", &IsotropicHardening::yieldStress, "Pa", "yield stress at the start", input::positive())
            .required("K", &IsotropicHardening::modulus, "Pa", "growth of the yield stress with the plastic strain",
                      input::nonNegative());
    return schema;
  }
  double flowStress(const FlowState& state) const { return yieldStress + modulus * state.plasticStrain; }
  /// The slope d sigma_y / d e_p.
  double hardening(const FlowState&) const { return modulus; }
};
static_assert(FlowRule<IsotropicHardening>);

/// The flow stress sigma_y = (A + B e_p^n) (1 + C ln e*) (1 - T*^m), e* = rate / epdot_0, T* = (T - T_r) / (T_m - T_r):
/// Johnson & Cook, Proc. 7th Int. Symp. on Ballistics (1983) 541. As in Uintah, the rate factor is (1 + e*)^C below
/// epdot_0, the temperature factor is 1 - T* below T_r, and 0 above T_m.
struct JohnsonCook {
  using Capabilities = CapabilityList<capability::Hardening>;
  static constexpr std::string_view name = "johnson_cook";

  double a = 0, b = 0;            ///< a and b [Pa]
  double c = 0, n = 0, m = 0;     ///< c, n and m [1]
  double referenceRate = 1;       ///< epdot_0 [1/s]
  double roomTemperature = 298;   ///< room temperature T_r [K]
  double meltTemperature = 1793;  ///< melting temperature T_m [K]

  static const input::Schema<JohnsonCook>& schema() {
    static const input::Schema<JohnsonCook> schema =
        input::Schema<JohnsonCook>("flow_model", "The Johnson-Cook yield stress.")
            .required("A", &JohnsonCook::a, "Pa", "yield stress at the start", input::positive())
            .required("B", &JohnsonCook::b, "Pa", "factor of e_p^n", input::nonNegative())
            .required("C", &JohnsonCook::c, "1", "factor of the logarithm of the strain rate", input::nonNegative())
            .required("n", &JohnsonCook::n, "1", "exponent of the plastic strain", input::positive())
            .required("m", &JohnsonCook::m, "1", "exponent of the temperature", input::positive())
            .value("epdot_0", &JohnsonCook::referenceRate, 1, "1/s", "reference strain rate", input::positive())
            .value("T_r", &JohnsonCook::roomTemperature, 298, "K", "reference temperature", input::nonNegative())
            .value("T_m", &JohnsonCook::meltTemperature, 1793, "K", "temperature above which there is no strength",
                   input::positive())
            .check([](const JohnsonCook& read, const input::Element& element, input::Diagnostics& diagnostics) {
              if (read.meltTemperature <= read.roomTemperature)
                diagnostics.error(element, "T_m is not greater than T_r");
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
static_assert(FlowRule<JohnsonCook>);

/// The flow stress sigma_y = c_0 + B exp(-beta T) + B_0 e_p^(1/2) exp(-alpha T) + K e_p^n, alpha = alpha_0 - alpha_1 ln
/// rate, beta likewise: Zerilli & Armstrong, J. Appl. Phys. 61 (1987) 1816. As in Uintah, the rate is that of the
/// plastic strain, and at least 1e-8/s.
struct ZerilliArmstrong {
  using Capabilities = CapabilityList<>;
  static constexpr std::string_view name = "zerilli_armstrong";

  double c0 = 0, b = 0, b0 = 0, k = 0;  ///< c0, b, b0 and k [Pa]
  double n = 0;                         ///< n [1]
  double alpha0 = 0, alpha1 = 0;        ///< alpha0 and alpha1 [1/K]
  double beta0 = 0, beta1 = 0;          ///< beta0 and beta1 [1/K]

  static const input::Schema<ZerilliArmstrong>& schema() {
    using Self = ZerilliArmstrong;
    static const input::Schema<Self> schema =
        input::Schema<Self>("flow_model", "The Zerilli-Armstrong yield stress.")
            .custom("c_0", readConstantPart, {"c_0", "sigma_g", "k_H", "sqrt_l_inv"},
                    "constant part, Pa; or <sigma_g> + <k_H> <sqrt_l_inv>, from the grain size")
            .forms({input::typeForm({"c_0", "sigma_g", "k_H", "sqrt_l_inv"}, std::string(input::typeName<double>))})
            .required("B", &Self::b, "Pa", "part without hardening", input::nonNegative())
            .required("beta_0", &Self::beta0, "1/K", "decrease of this part with the temperature", input::nonNegative())
            .required("beta_1", &Self::beta1, "1/K", "increase of this part with the logarithm of the strain rate",
                      input::nonNegative())
            .required("B_0", &Self::b0, "Pa", "part that grows with the square root of the plastic strain",
                      input::nonNegative())
            .required("alpha_0", &Self::alpha0, "1/K", "decrease of that part with the temperature",
                      input::nonNegative())
            .required("alpha_1", &Self::alpha1, "1/K", "increase of that part with the logarithm of the strain rate",
                      input::nonNegative())
            .required("K", &Self::k, "Pa", "factor of e_p^n", input::nonNegative())
            .required("n", &Self::n, "1", "exponent of the plastic strain", input::nonNegative());
    return schema;
  }
  double flowStress(const FlowState& state) const {
    const double ep = state.plasticStrain;
    return c0 + b * fading(beta0, beta1, state) + b0 * std::sqrt(ep) * fading(alpha0, alpha1, state) +
           k * std::pow(ep, n);
  }

 private:
  /// Reads c_0, or Hall and Petch's sigma_g + k_H l^(-1/2) for grains of size l.
  static void readConstantPart(ZerilliArmstrong& read, const input::Element& element, input::Diagnostics& diagnostics) {
    std::array<double, 4> values{};
    for (std::size_t k = 0; const char* name : {"c_0", "sigma_g", "k_H", "sqrt_l_inv"}) {
      const auto given = element.child(name);
      const auto value = given ? input::parse<double>(given->text()) : input::parse<double>("0");
      if (!value.problem.empty()) diagnostics.error(*given, value.problem);
      values[k++] = value.value.value_or(0);
    }
    if (!element.child("c_0") && !element.child("sigma_g"))
      diagnostics.error(element, "missing tag <c_0> in <flow_model> (the constant part)");
    read.c0 = values[0] + values[1] + values[2] * values[3];
    if (read.c0 < 0) diagnostics.error(element, "c_0 is below 0 Pa");
  }
  static double fading(double byTemperature, double byRate, const FlowState& state) {
    const double logarithm = std::log(std::max(state.plasticStrainRate, 1e-8));
    return std::exp(-(byTemperature - byRate * logarithm) * state.temperature);
  }
};
static_assert(FlowRule<ZerilliArmstrong>);

using FlowModel = std::variant<IsotropicHardening, JohnsonCook, MechanicalThreshold, PrestonTonksWallace,
                               SteinbergCochranGuinan, ZerilliArmstrong>;

/// The slope d sigma_y / d e_p of a flow model at a constant rate [Pa].
template <FlowRule Flow>
double hardeningAtRate(const Flow& flow, const FlowState& state) {
  if constexpr (providesCapability<Flow, capability::Hardening>) {
    return flow.hardening(state);
  } else {
    const double h = std::min(1e-5 * std::max(state.plasticStrain, 1e-6), 0.5 * state.plasticStrain);
    const auto at = [&](double more) {
      FlowState moved = state;
      moved.plasticStrain += more;
      return flow.flowStress(moved);
    };
    return h > 0 ? (at(h) - at(-h)) / (2 * h) : 0;
  }
}

/// A radial return to the yield surface of a flow model, in a step of length `timeStep` [s].
template <FlowRule Flow>
class RadialReturn {
 public:
  RadialReturn(const Flow& flow, const FlowState& start, double timeStep)
      : flow_(flow), start_(start), time_step_(timeStep) {}

  /// Amount q by which the return reduces the trial stress s [Pa]: the root of |s| - q = (2/3)^(1/2) sigma_y, where e_p
  /// exceeds its initial value by (2/3)^(1/2) q/(2 G); by Newton's iteration between bounds. Simo & Hughes,
  /// Computational Inelasticity (1998), box 3.1.
  double excess(double trialSize) const {
    double low = 0, high = trialSize - root_ * flow_.flowStress(start_), q = high;
    if (high <= 0) return 0;
    for (int step = 0; step < 100; ++step) {
      const FlowState state = after(q);
      const double excess = trialSize - q - root_ * flow_.flowStress(state);
      (excess > 0 ? low : high) = q;
      if (std::abs(excess) <= 1e-14 * trialSize) break;
      const double slope = 1 + root_ * perStress() * hardening(state), newton = q + excess / slope;
      q = newton > low && newton < high ? newton : 0.5 * (low + high);
    }
    return q;
  }
  /// State at the end of a step whose return shortens the trial stress by q [Pa].
  FlowState after(double q) const {
    FlowState state = start_;
    state.plasticStrain += perStress() * q;
    state.plasticStrainRate = perStress() * q / time_step_;
    return state;
  }
  /// The slope d sigma_y / d e_p [Pa], where the plastic strain rate of the step is a function of e_p.
  double hardening(const FlowState& state) const {
    if constexpr (providesCapability<Flow, capability::Hardening>)
      if (!dependsOnPlasticRate()) return flow_.hardening(state);
    const double h = 1e-5 * std::max(state.plasticStrain - start_.plasticStrain, 1e-6);
    const auto at = [&](double more) {
      FlowState moved = state;
      moved.plasticStrain += more;
      moved.plasticStrainRate += more / time_step_;
      return flow_.flowStress(moved);
    };
    return (at(h) - at(-h)) / (2 * h);
  }
  /// Plastic strain per q, (2/3)^(1/2) / (2 G) [1/Pa].
  double perStress() const { return root_ / (2 * start_.shearModulus); }

 private:
  bool dependsOnPlasticRate() const {
    if constexpr (providesCapability<Flow, capability::PlasticRate>) return flow_.dependsOnPlasticRate();
    return false;
  }

  const Flow& flow_;
  FlowState start_;
  double time_step_, root_ = std::sqrt(2.0 / 3.0);
};

}  // namespace tushar::mpm::solid
