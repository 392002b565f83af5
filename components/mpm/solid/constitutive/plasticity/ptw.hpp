#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "components/mpm/solid/constitutive/plasticity/flow_rule.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The flow stress sigma_y = 2 G t, t = t_s + A ln(1 - (1 - exp(-B/A)) exp(-theta e_p / (A (exp(B/A) - 1)))), A = (s_0
/// - t_y)/p, B = t_s - t_y: Preston, Tonks & Wallace, J. Appl. Phys. 93 (2003) 211. With x = kappa T/T_m ln(gamma/r),
/// where r is the plastic strain rate times the time in which a transverse wave crosses an atom, t_s = s_0 - (s_0 -
/// s_inf) erf x and t_y likewise; above 1000/s at least t_s = s_0 (r/gamma)^beta and t_y = y_1 (r/gamma)^y_2, for
/// strong shocks.
struct PrestonTonksWallace {
  using Capabilities = CapabilityList<>;
  static constexpr std::string_view name = "preston_tonks_wallace";

  double theta = 0, p = 0, s0 = 0, sInfinite = 0, kappa = 0, gamma = 0, y0 = 0, yInfinite = 0, y1 = 0, y2 = 0, beta = 0;
  double atomicMass = 0;  ///< M, atomic mass [u]

  static const input::Schema<PrestonTonksWallace>& schema() {
    using Self = PrestonTonksWallace;
    static const input::Schema<Self> schema =
        input::Schema<Self>("flow_model", "The Preston-Tonks-Wallace yield stress.")
            .required("theta", &Self::theta, "1", "hardening", input::positive())
            .required("p", &Self::p, "1", "shape of the saturation of hardening", input::positive())
            .required("s0", &Self::s0, "1", "saturated stress at 0 K", input::positive())
            .required("sinf", &Self::sInfinite, "1", "saturated stress near melting", input::nonNegative())
            .required("kappa", &Self::kappa, "1", "softening with the temperature", input::nonNegative())
            .required("gamma", &Self::gamma, "1", "factor of the reference strain rate", input::positive())
            .required("y0", &Self::y0, "1", "yield stress at 0 K", input::nonNegative())
            .required("yinf", &Self::yInfinite, "1", "yield stress near melting", input::nonNegative())
            .required("y1", &Self::y1, "1", "yield stress in strong shocks", input::nonNegative())
            .required("y2", &Self::y2, "1", "exponent of the yield stress in strong shocks", input::nonNegative())
            .required("beta", &Self::beta, "1", "exponent of the saturated stress in strong shocks",
                      input::nonNegative())
            .required("M", &Self::atomicMass, "u", "mass of an atom", input::positive())
            .ignored("G0", "it is part of the <shear_modulus_model>")
            .ignored("alpha", "it is part of the <shear_modulus_model>")
            .ignored("alphap", "it is part of the <shear_modulus_model>")
            .check([](const Self& read, const input::Element& element, input::Diagnostics& diagnostics) {
              if (read.y0 >= read.s0) diagnostics.error(element, "y0 is not less than s0");
            });
    return schema;
  }
  double flowStress(const FlowState& state) const {
    const double rate = std::max(state.plasticStrainRate, 1e-8), relative = rate / frequency(state);
    const double softening = std::erf(kappa * state.temperature / state.meltTemperature * std::log(gamma / relative));
    double saturated = s0 - (s0 - sInfinite) * softening, yield = y0 - (y0 - yInfinite) * softening;
    if (rate > 1e3) {
      const double shock = s0 * std::pow(relative / gamma, beta);
      yield = std::max(yield, std::min(y1 * std::pow(relative / gamma, y2), shock));
      saturated = std::max(saturated, shock);
    }
    return 2 * state.shearModulus * hardened(saturated, yield, state.plasticStrain);
  }

 private:
  /// The frequency 1/2 (4 pi rho / (3 M))^(1/3) (G/rho)^(1/2) [1/s].
  double frequency(const FlowState& state) const {
    constexpr double atomicMassUnit = 1.66053906660e-27;
    const double atoms = state.density / (atomicMass * atomicMassUnit);
    return 0.5 * std::cbrt(4 * std::numbers::pi / 3 * atoms) * std::sqrt(state.shearModulus / state.density);
  }
  double hardened(double saturated, double yield, double plasticStrain) const {
    const double a = (s0 - yield) / p, b = saturated - yield;
    if (b <= 0 || a <= 0) return saturated;
    const double range = std::min(b / a, 700.0);  // exp(700) is nearly the greatest number
    const double hardening = theta * plasticStrain / (a * std::expm1(range));
    return yield + a * (range + std::log(std::exp(-range - hardening) - std::expm1(-hardening)));
  }
};
static_assert(FlowRule<PrestonTonksWallace>);

}  // namespace tushar::mpm::solid
