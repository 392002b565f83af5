#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "components/mpm/solid/constitutive/plasticity/flow_rule.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

/// The mechanical threshold stress, sigma_y = sigma_a + (S_i sigma_i + S_e sigma_e) G/mu_0 with the strain rate r:
/// S = (1 - (k T / (g_0 b^3 G) ln(r_0/r))^(1/q))^(1/p), at least 0, for obstacles i and e;
/// d sigma_e / d e_p = theta_0 (1 - tanh(alpha sigma_e/sigma_es) / tanh(alpha)),
/// theta_0 = a_0 + a_1 ln r + a_2 r^(1/2) - a_3 T, sigma_es = sigma_es0 (r/r_es0)^(k T / (g_0es b^3 G)):
/// Follansbee & Kocks, Acta Metall. 36 (1988) 81; Goto et al., Metall. Mater. Trans. A 31 (2000) 1985.
/// Four implicit midpoint steps give sigma_e, as in Uintah.
struct MechanicalThreshold {
  using Capabilities = CapabilityList<>;
  static constexpr std::string_view name = "mts_model";

  double athermal = 0;              ///< athermal stress sigma_a [Pa]
  double shearModulus = 0;          ///< shear modulus mu_0 [Pa]
  double boltzmann = 0;             ///< ratio k/b^3 [Pa/K]
  double energyI = 0, energyE = 0;  ///< activation energies g_0i and g_0e [1]
  double rateI = 0, rateE = 0;      ///< reference rates r_0i and r_0e [1/s]
  double pI = 0, qI = 0, pE = 0, qE = 0;
  double sigmaI = 0;                      ///< sigma_i [Pa]
  double a0 = 0, a1 = 0, a2 = 0, a3 = 0;  ///< a0 and a1 [Pa], a2 [Pa s^(1/2)], a3 [Pa/K]
  double alpha = 0;                       ///< alpha [1]
  double rateSaturated = 0;               ///< reference rate of saturation r_es0 [1/s]
  double energySaturated = 0;             ///< activation energy of saturation g_0es [1]
  double sigmaSaturated = 0;              ///< sigma_es0 [Pa]

  static const input::Schema<MechanicalThreshold>& schema() {
    static const input::Schema<MechanicalThreshold> schema = makeSchema();
    return schema;
  }
  double flowStress(const FlowState& state) const {
    const double rate = state.strainRate > 0 ? state.strainRate : 1e-7;
    const double heat = boltzmann * state.temperature / state.shearModulus;
    const double first = a0 + a1 * std::log(rate) + a2 * std::sqrt(rate) - a3 * state.temperature;
    const double saturated = sigmaSaturated * std::pow(rate / rateSaturated, heat / energySaturated);
    const double evolved = thresholdAt(state.plasticStrain, std::max(first, 0.0), saturated);
    const double initial = pI > 0 ? sigmaI * share(heat / energyI * std::log(rateI / rate), pI, qI) : 0.0;
    const double hardened = evolved * share(heat / energyE * std::log(rateE / rate), pE, qE);
    return athermal + (initial + hardened) * state.shearModulus / shearModulus;
  }

 private:
  static input::Schema<MechanicalThreshold> makeSchema() {
    using Self = MechanicalThreshold;
    input::Schema<Self> tags("flow_model", "The mechanical threshold stress of Follansbee and Kocks.");
    tags.required("sigma_a", &Self::athermal, "Pa", "part without thermal activation", input::nonNegative())
        .required("mu_0", &Self::shearModulus, "Pa", "shear modulus at 0 K", input::positive())
        .required("koverbcubed", &Self::boltzmann, "Pa/K", "Boltzmann's constant divided by the Burgers vector cubed",
                  input::positive())
        .required("g_0i", &Self::energyI, "1", "activation energy for interstitial obstacles", input::nonNegative())
        .required("g_0e", &Self::energyE, "1", "activation energy for dislocations", input::positive())
        .required("edot_0i", &Self::rateI, "1/s", "reference rate for interstitial obstacles", input::nonNegative())
        .required("edot_0e", &Self::rateE, "1/s", "reference rate for dislocations", input::positive())
        .required("p_i", &Self::pI, "1", "exponent; 0: no interstitial obstacles", input::nonNegative())
        .required("q_i", &Self::qI, "1", "exponent", input::nonNegative())
        .required("p_e", &Self::pE, "1", "exponent", input::positive())
        .required("q_e", &Self::qE, "1", "exponent", input::positive())
        .required("sigma_i", &Self::sigmaI, "Pa", "threshold of interstitial obstacles", input::nonNegative());
    tags.required("a_0", &Self::a0, "Pa", "hardening at the start")
        .required("a_1", &Self::a1, "Pa", "growth of the hardening with the logarithm of the rate")
        .required("a_2", &Self::a2, "Pa s^(1/2)", "growth of the hardening with the square root of the rate")
        .required("a_3", &Self::a3, "Pa/K", "decrease of the hardening with the temperature")
        .required("alpha", &Self::alpha, "1", "shape of the saturation of hardening", input::positive())
        .required("edot_es0", &Self::rateSaturated, "1/s", "reference rate of saturation", input::positive())
        .required("g_0es", &Self::energySaturated, "1", "activation energy of saturation", input::positive())
        .required("sigma_es0", &Self::sigmaSaturated, "Pa", "saturated threshold at 0 K", input::positive())
        .ignored("theta_IV", "as in Uintah, hardening falls to 0 at saturation")
        .ignored("D", "it is part of the <shear_modulus_model>")
        .ignored("T_0", "it is part of the <shear_modulus_model>");
    refuseTag(tags, "T_c", "there is only one phase");
    tags.check([](const Self& read, const input::Element& element, input::Diagnostics& diagnostics) {
      if (read.pI > 0 && !(read.energyI > 0 && read.rateI > 0 && read.qI > 0))
        diagnostics.error(element, "p_i is greater than 0, but g_0i, edot_0i and q_i are not");
    });
    return tags;
  }
  /// The ratio (1 - x^(1/q))^(1/p).
  static double share(double x, double p, double q) {
    const double left = 1 - std::pow(std::max(x, 0.0), 1 / q);
    return left > 0 ? std::pow(left, 1 / p) : 0.0;
  }
  double thresholdAt(double plasticStrain, double hardening, double saturated) const {
    const double step = plasticStrain / 4 * hardening, steepness = 0.5 * alpha / saturated,
                 share = step / std::tanh(alpha);
    double threshold = 0;
    for (int k = 0; k < 4; ++k) {
      const double before = threshold;
      threshold += step * (1 - std::tanh(2 * steepness * before) / std::tanh(alpha));
      for (int iteration = 0; iteration < 50; ++iteration) {
        const double t = std::tanh(steepness * (before + threshold));
        const double change = (threshold - before - step + share * t) / (1 + share * steepness * (1 - t * t));
        threshold -= change;
        if (std::abs(change) <= 1e-14 * saturated) break;
      }
      if (threshold > saturated) return saturated;
    }
    return threshold;
  }
};
static_assert(FlowRule<MechanicalThreshold>);

}  // namespace tushar::mpm::solid
