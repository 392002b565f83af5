#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "components/mpm/solid/constitutive/plasticity/flow_rule.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The flow stress sigma_y = (sigma_T + min(sigma_0 (1 + beta (e_p + epsilon_p0))^n, Y_max)) G/mu_0: Steinberg, Cochran
/// & Guinan, J.
/// Appl. Phys. 51 (1980) 1498. If C1 and C2 are given, sigma_T is the stress at which thermally activated dislocations
/// move at the rate of the plastic strain, 1/rate = exp(2 U_k / (k T) (1 - sigma_T / sigma_P)^2) / C1 + C2 / sigma_T,
/// at most Peierls' stress sigma_P: Steinberg & Lund, J. Appl. Phys. 65 (1989) 1528. Otherwise it is 0.
struct SteinbergCochranGuinan {
  using Capabilities = CapabilityList<capability::Hardening, capability::PlasticRate>;
  static constexpr std::string_view name = "steinberg_cochran_guinan";

  double shearModulus = 0;            ///< shear modulus mu_0 [Pa]
  double yieldStress = 0;             ///< sigma_0 [Pa]
  double greatest = 0;                ///< Y_max, largest yield stress [Pa]
  double beta = 0, n = 0;             ///< beta and n [1]
  double initialStrain = 0;           ///< epsilon_p0 [1]
  double c1 = 0;                      ///< c1 [1/s]
  double c2 = 0;                      ///< c2 [Pa s]
  double kinkEnergy = 0;              ///< kink energy U_k [eV]
  double boltzmann = 8.617333262e-5;  ///< Boltzmann's constant k [eV/K]
  double peierls = 0;                 ///< sigma_P [Pa]

  static const input::Schema<SteinbergCochranGuinan>& schema() {
    using Self = SteinbergCochranGuinan;
    static const input::Schema<Self> schema =
        input::Schema<Self>("flow_model", "The yield stress of Steinberg, Cochran, Guinan and Lund.")
            .required("mu_0", &Self::shearModulus, "Pa", "shear modulus in the reference state", input::positive())
            .required("sigma_0", &Self::yieldStress, "Pa", "yield stress without hardening", input::positive())
            .required("Y_max", &Self::greatest, "Pa", "largest yield stress after hardening", input::positive())
            .required("beta", &Self::beta, "1", "factor of the plastic strain", input::nonNegative())
            .required("n", &Self::n, "1", "exponent of the hardening", input::nonNegative())
            .value("epsilon_p0", &Self::initialStrain, 0, "1", "plastic strain at the start", input::nonNegative())
            .value("C1", &Self::c1, 0, "1/s", "rate of thermal activation; 0: the strain rate has no effect",
                   input::nonNegative())
            .value("C2", &Self::c2, 0, "Pa s", "drag coefficient of dislocations", input::nonNegative())
            .value("energy_to_form_kink_pair", &Self::kinkEnergy, 0, "eV", "U_k", input::nonNegative())
            .value("Boltzmann_constant", &Self::boltzmann, 8.617333262e-5, "eV/K", "k", input::positive())
            .value("Peierls_stress", &Self::peierls, 0, "Pa", "largest stress from thermal activation",
                   input::nonNegative())
            .ignored("A", "it is part of the <shear_modulus_model>")
            .ignored("B", "it is part of the <shear_modulus_model>")
            .ignored("T_m0", "it is part of the <melting_temp_model>")
            .ignored("Gamma_0", "it is part of the <melting_temp_model>")
            .ignored("a", "it is part of the <melting_temp_model>")
            .check([](const Self& read, const input::Element& element, input::Diagnostics& diagnostics) {
              if (read.c1 > 0 && read.peierls <= 0) diagnostics.error(element, "<C1> needs <Peierls_stress>");
            });
    return schema;
  }
  double flowStress(const FlowState& state) const {
    return (thermal(state) + std::min(hardened(state), greatest)) * state.shearModulus / shearModulus;
  }
  bool dependsOnPlasticRate() const { return c1 > 0; }
  /// The slope of the flow stress at a constant rate.
  double hardening(const FlowState& state) const {
    if (hardened(state) >= greatest) return 0;
    return beta * n * hardened(state) / base(state) * state.shearModulus / shearModulus;
  }

 private:
  double base(const FlowState& state) const { return 1 + beta * (state.plasticStrain + initialStrain); }
  double hardened(const FlowState& state) const { return yieldStress * std::pow(base(state), n); }
  /// The thermal part sigma_T [Pa], by bisection: the rate increases with sigma_T.
  double thermal(const FlowState& state) const {
    if (c1 == 0 || state.plasticStrainRate <= 0) return 0;
    double low = 0, high = peierls;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high), away = 1 - middle / peierls;
      const double time = std::exp(2 * kinkEnergy / (boltzmann * state.temperature) * away * away) / c1 + c2 / middle;
      (state.plasticStrainRate * time > 1 ? low : high) = middle;
    }
    return high;
  }
};
static_assert(FlowRule<SteinbergCochranGuinan>);

}  // namespace tushar::mpm::solid
