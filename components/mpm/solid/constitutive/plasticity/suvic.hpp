#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "components/mpm/solid/tensor.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// Ice and salt: SUVIC, one inelastic strain rate with three internal stresses that saturate; Aubertin, Gill &
/// Ladanyi, Mech. Mater. 11 (1991) 63. With X = (3/2 (s - B):(s - B))^(1/2) and n = 3/2 (s - B)/X:
///
///     e' = A exp(-Q/(R_u T)) <(X - R)/K>^N,   de_ij/dt = e' n_ij,
///     dB_ij/dt = A1 (2/3 de_ij/dt - B_ij/B' e'),   dR/dt = A3 (1 - R/R') e',   dK/dt = A5 (1 - K/K') e',
///     B' = B0 (e'/e0)^(1/n),  R' = R0 (e'/e0)^(1/m),
///     K' = (S0 (e'/e0)^(1/N) - R' - B')/(e'/(A exp(-Q/(R_u T))))^(1/N).
///
/// R and K do not fall, as in Uintah.
struct SuvicI {
  /// Internal stresses [Pa].
  struct Stresses {
    double yield;  ///< yield stress R
    double drag;   ///< drag stress K
    Matrix3 back;  ///< back stress B
  };
  static constexpr std::string_view name = "suvic_i";

  double backGrowth = 75e6;         ///< back stress growth A1 [Pa]
  double backSaturation = 0.1e6;    ///< back stress saturation B0 [Pa]
  double backExponent = 4;          ///< back stress exponent n [1]
  double referenceRate = 7.794e-8;  ///< reference rate e0 [1/s]
  double rateFactor = 5e9;          ///< rate factor A [1/s]
  double activationEnergy = 67500;  ///< activation energy Q [J/mol]
  double gasConstant = 8.3144;      ///< gas constant R_u [J/(mol K)]
  double temperature = 269.15;      ///< temperature T [K]
  double rateExponent = 4;          ///< rate exponent N [1]
  double yieldSaturation = 0.8e6;   ///< yield saturation R0 [Pa]
  double yieldExponent = 4;         ///< yield exponent m [1]
  double yieldGrowth = 1600e6;      ///< yield growth A3 [Pa]
  double dragGrowth = 95e6;         ///< drag growth A5 [Pa]
  double stressSaturation = 1e6;    ///< stress saturation S0 [Pa]
  double initialDrag = 0.05e6;      ///< initial K [Pa]
  double initialYield = 0;          ///< initial R [Pa]

  static const input::Schema<SuvicI>& schema() {
    static const input::Schema<SuvicI> schema = makeSchema();
    return schema;
  }

  /// Relaxes the trial stress deviator `stress` [Pa] in a step by backward Euler, so that any time step is stable.
  /// Returns the inelastic strain of the step. The deviator of s - B keeps the direction of z = s_trial - B/(1 + A1
  /// e/B'), so that the strain e is the root of one equation, X - R - K (e/(dt A exp(-Q/(R_u T))))^(1/N) = 0.
  double relax(double shearModulus, double timeStep, Matrix3& stress, Stresses& internal) const {
    const Step step{*this, shearModulus, timeStep, stress, internal};
    if (std::sqrt(1.5) * (stress - internal.back).norm() <= internal.yield) return 0;
    const double strain = step.strain();
    if (strain <= 0) return 0;
    const Point at = step.pointAt(strain);
    const Matrix3 direction = 1.5 / at.reduced * at.z;
    stress -= 2 * shearModulus * strain * direction;
    internal = {at.yield, at.drag, at.kept * (internal.back + 2.0 / 3.0 * backGrowth * strain * direction)};
    return strain;
  }

 private:
  /// The state at the end of a step with a given inelastic strain.
  struct Point {
    double kept;     ///< factor 1/(1 + A1 e/B') of the back stress [1]
    Matrix3 z;       ///< s_trial - kept B [Pa]
    double reduced;  ///< equivalent reduced stress (3/2 z:z)^(1/2) [Pa]
    double yield;    ///< yield stress R [Pa]
    double drag;     ///< drag stress K [Pa]
  };
  struct Step {
    const SuvicI& model;
    double shearModulus, timeStep;
    const Matrix3& trial;
    const Stresses& start;

    Point pointAt(double strain) const {
      const double rate = strain / timeStep, relative = rate / model.referenceRate;
      const double back = model.backSaturation * std::pow(relative, 1 / model.backExponent);
      const double yield = model.yieldSaturation * std::pow(relative, 1 / model.yieldExponent);
      const double whole = model.stressSaturation * std::pow(relative, 1 / model.rateExponent);
      const double drag = (whole - yield - back) / model.overstress(rate);
      const double kept = 1 / (1 + model.backGrowth * strain / back);
      const Matrix3 z = trial - kept * start.back;
      return {kept, z, std::sqrt(1.5) * z.norm(), grown(start.yield, yield, model.yieldGrowth * strain),
              grown(start.drag, drag, model.dragGrowth * strain)};
    }
    /// Solves for the strain, using the method of false position in the variable e^(1/N), in which slow creep is
    /// linear; Dowell & Jarratt, BIT 11 (1971) 168.
    double strain() const {
      const double greatest = std::sqrt(1.5) * (trial.norm() + start.back.norm()) / (3 * shearModulus);
      double low = 0, high = std::pow(greatest, 1 / model.rateExponent), root = high;
      double atLow = std::sqrt(1.5) * (trial - start.back).norm() - start.yield, atHigh = misfit(high);
      for (int k = 0; k < 200 && high - low > 1e-15 * high; ++k) {
        root = (low * atHigh - high * atLow) / (atHigh - atLow);
        const double at = misfit(root);
        if (at == 0) break;
        if ((at < 0) == (atHigh < 0)) {
          high = root, atHigh = at, atLow /= 2;
        } else {
          low = root, atLow = at, atHigh /= 2;
        }
      }
      return std::pow(root, model.rateExponent);
    }
    double misfit(double variable) const {
      const double strain = std::pow(variable, model.rateExponent);
      if (strain <= 0) return std::sqrt(1.5) * (trial - start.back).norm() - start.yield;
      const Point at = pointAt(strain);
      const double stress = at.reduced - (3 * shearModulus + at.kept * model.backGrowth) * strain;
      return stress - at.yield - at.drag * model.overstress(strain / timeStep);
    }
    static double grown(double old, double saturated, double growth) {
      return saturated > old ? (old + growth) / (1 + growth / saturated) : old;
    }
  };
  /// The overstress (X - R)/K at a rate.
  double overstress(double rate) const {
    return std::pow(rate / (rateFactor * std::exp(-activationEnergy / (gasConstant * temperature))), 1 / rateExponent);
  }

  static input::Schema<SuvicI> makeSchema() {
    using Self = SuvicI;
    input::Schema<Self> tags("visco_plasticity_model",
                             "SUVIC: creep and plasticity of ice, unified in one inelastic strain rate.");
    const auto stress = [&](const char* tag, double Self::*member, const char* sentence) {
      tags.value(tag, member, Self().*member, "Pa", sentence, input::positive());
    };
    const auto exponent = [&](const char* tag, double Self::*member, const char* sentence) {
      tags.value(tag, member, Self().*member, "1", sentence, input::positive());
    };
    stress("coeff_backstress_evol", &Self::backGrowth, "A1: growth of the back stress with the strain");
    stress("coeff_saturation_backstress", &Self::backSaturation, "B0: largest back stress at the rate e0");
    exponent("exponent_backstress", &Self::backExponent, "n: exponent of the rate in the largest back stress");
    tags.value("ref_strainrate", &Self::referenceRate, 7.794e-8, "1/s", "e0", input::positive())
        .value("normalizing_inelastic_strainrate", &Self::rateFactor, 5e9, "1/s", "A", input::positive())
        .value("activation_energy", &Self::activationEnergy, 67500, "J/mol", "Q", input::nonNegative())
        .value("universal_gas_constant", &Self::gasConstant, 8.3144, "J/(mol K)", "R_u", input::positive())
        .value("temperature", &Self::temperature, 269.15, "K", "T; the temperature of the particles has no effect",
               input::positive());
    exponent("exponent_inelastic_strainrate", &Self::rateExponent, "N: exponent of the stress in the strain rate");
    stress("coeff_yieldstress_saturation", &Self::yieldSaturation, "R0: largest yield stress at the rate e0");
    exponent("exponent_yieldstress", &Self::yieldExponent, "m: exponent of the rate in the largest yield stress");
    stress("coeff_yieldstress_evol", &Self::yieldGrowth, "A3: growth of the yield stress with the strain");
    stress("coeff_dragstress_evol", &Self::dragGrowth, "A5: growth of the drag stress with the strain");
    stress("coeff_stress_saturation", &Self::stressSaturation, "S0: largest stress at the rate e0");
    stress("intial_drag", &Self::initialDrag, "drag stress at the start (Uintah's spelling)");
    tags.value("initial_yield", &Self::initialYield, 0, "Pa", "yield stress at the start", input::nonNegative())
        .ignored("exponent_backstress_evol", "Uintah does not use it either")
        .ignored("normalizing_backstress", "Uintah does not use it either")
        .ignored("exponent_dragstress", "Uintah does not use it either")
        .ignored("integration_parameter_theta", "the step is implicit");
    return tags;
  }
};

}  // namespace tushar::mpm::solid
